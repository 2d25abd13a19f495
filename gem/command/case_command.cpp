// gem case: its subcommands check, resolve, explain and schema.
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/field/field.h"
#include "gem/record/line_tensions.h"
#include "gem/scene/check_scene.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_drive.h"
#include "gem/scene/scene_mooring.h"
#include "gem/scene/toml/case_text.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {

namespace {

std::string check_json(const SceneDef& scene, const FieldSummary& field, const std::vector<std::string>& warnings) {
  nlohmann::ordered_json object = {{"name", scene.run.name},
                                   {"case_sha256", scene_hash(scene)},
                                   {"floes", field.floe_count},
                                   {"size_mean_m", field.size_mean},
                                   {"size_deviation_m", field.size_deviation},
                                   {"size_minimum_m", field.size_minimum},
                                   {"size_maximum_m", field.size_maximum},
                                   {"cover", field.cover},
                                   {"smallest_gap_m", nullptr},
                                   {"ice_mass_kg", field.ice_mass},
                                   {"thickness_minimum_m", field.thickness_minimum},
                                   {"thickness_maximum_m", field.thickness_maximum},
                                   {"sides", field.sides},
                                   {"fixed_bodies", scene.fixed.size()},
                                   {"warnings", warnings}};
  if (!field.concave.empty()) object["concave"] = field.concave;
  if (!field.concentration.empty()) object["concentration"] = field.concentration;
  if (std::isfinite(field.smallest_gap)) object["smallest_gap_m"] = field.smallest_gap;
  return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// Natural period without damping, to compare with the known period of the platform.
std::string mooring_text(const SceneDef& scene) {
  if (scene.platform.fixed) return "fixed";
  const double x = natural_period(scene), y = natural_period(scene, {0.0, 1.0});
  const auto along = [](double period) { return period > 0.0 ? number_text(period, 4) + " s" : std::string("none"); };
  if (x > 0.0 && number_text(x, 4) == number_text(y, 4)) return "natural period " + along(x);
  if (x > 0.0 || y > 0.0) return "natural period " + along(x) + " along x, " + along(y) + " along y";
  if (in_transit(scene.transit)) return "in transit";
  if (const std::size_t thrusters = scene.dp.thruster.size())
    return "held by " + std::to_string(thrusters) + " thrusters";
  return scene.mooring.law == MooringLaw::linear ? "not moored" : "moored, slack at rest";
}

/// Number of lines and their tensions, to compare with those of the design.
std::string lines_text(const SceneDef& scene) {
  const std::vector<double> tensions = line_tensions_at_start(scene);
  const auto [least, most] = std::minmax_element(tensions.begin(), tensions.end());
  return std::to_string(tensions.size()) + ", at the start with " + number_text(1e-3 * *least, 4) + " to " +
         number_text(1e-3 * *most, 4) + " kN";
}

std::string added_mass_text(const AddedMassDef& a) {
  return "surge " + number_text(a.surge_kg) + " kg, sway " + number_text(a.sway_kg) + " kg, yaw " +
         number_text(a.yaw_kg_m2) + " kg m2, sway with yaw " + number_text(a.sway_yaw_kg_m) + " kg m";
}

std::string shape_text(const PlatformDef& platform) {
  const std::size_t sides = platform_outline(platform).size();
  const std::string area = ", " + number_text(platform_area(platform), 4) + " m2";
  switch (platform.outline) {
    case PlatformOutline::ship:
      return "ship " + number_text(platform.length_m, 4) + " m x " + number_text(platform.beam_m, 4) + " m, " +
             std::to_string(sides) + " sides" + area;
    case PlatformOutline::listed:
      return "listed outline, " + std::to_string(sides) + " sides" + area;
    case PlatformOutline::pieces:
      return std::to_string(platform.piece.size()) + (platform.piece.size() == 1 ? " piece, " : " pieces, ") +
             std::to_string(sides) + " sides" + area;
    case PlatformOutline::regular:
      break;
  }
  return std::to_string(sides) + " sides, diameter " + number_text(platform.diameter_m, 4) + " m";
}

/// What slows the platform in the water, to compare with what was meant.
std::string drag_text(const PlatformDragDef& drag) {
  const std::string water = drag.water == DampingWater::still ? "still water" : "the current";
  const std::string coefficients = drag.law == PlatformDragLaw::round
                                       ? "coefficient " + number_text(drag.coefficient, 4)
                                       : "coefficients " + number_text(drag.surge_coefficient, 4) + " (surge), " +
                                             number_text(drag.sway_coefficient, 4) + " (sway), " +
                                             number_text(drag.yaw_coefficient, 4) + " (yaw)";
  return (drag.law == PlatformDragLaw::round ? "round, " : "by axis, ") + coefficients + ", draft " +
         number_text(drag.draft_m, 4) + " m, relative to " + water;
}

/// The largest speed of water or air, with its direction if it is constant.
std::string drive_text(double largest, Vec2 constant) {
  const std::string speed = number_text(largest, 4) + " m/s";
  if (largest != length(constant)) return "up to " + speed;
  if (largest == 0.0) return "none";
  return speed + ", direction " + number_text(std::atan2(constant.y, constant.x) * 180.0 / std::numbers::pi, 4) +
         " degrees from +x";
}

std::string thickness_text(const FieldSummary& field) {
  const std::string thinnest = number_text(field.thickness_minimum, 4),
                    thickest = number_text(field.thickness_maximum, 4);
  return thinnest == thickest ? thickest + " m" : thinnest + " to " + thickest + " m";
}

std::string check_text(const SceneDef& scene, const FieldSummary& field, const std::vector<std::string>& warnings) {
  std::string text = scene.run.name + ": the case is valid\n";
  const auto line = [&](const std::string& name, const std::string& value) {
    text += "  " + name + std::string(18 - name.size(), ' ') + value + "\n";
  };
  line("case", scene_hash(scene));
  line("run", number_text(scene.run.duration_s) + " s, " + fixed_text(double(steps_of(scene)), 0) + " time steps of " +
                  number_text(scene.numerics.time_step_s) + " s");
  line("current", drive_text(largest_current(scene), scene.current.velocity_m_per_s) + ", drift " +
                      number_text(100.0 * drive_speed(scene) * scene.numerics.time_step_s, 3) + " cm in a time step");
  if (has_wind(scene)) line("wind", drive_text(largest_wind(scene), scene.wind.velocity_m_per_s));
  if (scene.platform.present)
    line("platform",
         shape_text(scene.platform) + ", mass " + number_text(scene.platform.mass_kg) + " kg, " + mooring_text(scene));
  if (has_lines(scene)) line("mooring lines", lines_text(scene));
  if (scene.platform.present && !scene.platform.fixed && scene.platform_drag.present)
    line("platform drag", drag_text(scene.platform_drag));
  if (scene.platform.present && !scene.platform.fixed && added_mass(scene.added_mass, 1.0, 1.0, false).present)
    line("added mass", added_mass_text(scene.added_mass));
  if (!scene.fixed.empty()) line("fixed bodies", std::to_string(scene.fixed.size()));
  line("floes", std::to_string(field.floe_count));
  if (field.floe_count > 0) {
    line("size sqrt(area)", "mean " + fixed_text(field.size_mean, 3) + " m, sd " + fixed_text(field.size_deviation, 3) +
                                " m, " + fixed_text(field.size_minimum, 2) + " to " +
                                fixed_text(field.size_maximum, 2) + " m");
    if (scene.floes.source != FloeSource::listed) line("cover", fixed_text(field.cover, 4));
    if (!field.concave.empty()) line("concave floes", field.concave);
    if (!field.concentration.empty()) line("concentration", field.concentration);
    line("smallest gap", std::isfinite(field.smallest_gap) ? number_text(field.smallest_gap, 4) + " m" : "one body");
    line("ice", number_text(field.ice_mass, 6) + " kg, " + thickness_text(field) + " thick, crushes at " +
                    number_text(1e-6 * scene.ice.crushing_pressure_Pa, 4) + " MPa on 1 m2");
    std::string sides;
    for (std::size_t n = 0; n < field.sides.size(); ++n) {
      if (field.sides[n] > 0)
        sides += (sides.empty() ? "" : ", ") + std::to_string(n) + ": " + std::to_string(field.sides[n]);
    }
    line("floes by sides", sides);
  }
  for (const std::string& warning : warnings) text += "  warning: " + warning + "\n";
  return text;
}

struct CaseOptions {
  CaseChoice chosen_case;
  std::string out;
  std::string key;
  bool json = false;
  bool markdown = false;
};

int explain_keys(const CaseOptions& options) {
  if (options.json) print(explain_json(options.key));
  if (options.markdown) print(explain_markdown(options.key));
  if (!options.json && !options.markdown) print(explain(options.key));
  return 0;
}

int check(const CaseOptions& options) {
  const SceneDef scene = read_case(options.chosen_case);
  const std::vector<std::string> warnings = scene_warnings(scene);
  const SceneDef listed = with_floes_of_run_file(scene);
  const FieldSummary field = summarise(listed, make_field(listed));
  print(options.json ? check_json(scene, field, warnings) : check_text(scene, field, warnings));
  return 0;
}

int resolve(const CaseOptions& options) {
  const SceneDef scene = read_case(options.chosen_case);
  if (!options.json) {
    print(resolved_toml(scene));
    return 0;
  }
  const nlohmann::ordered_json object = {
      {"name", scene.run.name}, {"case_sha256", scene_hash(scene)}, {"toml", resolved_toml(scene)}};
  print(object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  return 0;
}

}  // namespace

void add_case_command(CLI::App& app, Chosen& chosen) {
  CLI::App* group = app.add_subcommand("case", "check, resolve and explain cases");
  group->require_subcommand(1);
  const auto options = std::make_shared<CaseOptions>();

  CLI::App* check_case = group->add_subcommand("check", "check a case, make its field and print its statistics");
  add_case_options(*check_case, options->chosen_case, false);
  check_case->add_flag("--json", options->json, "as JSON");
  check_case->callback([options, &chosen] { chosen.action = [options] { return check(*options); }; });

  CLI::App* resolve_case =
      group->add_subcommand("resolve", "print a case with every option, as it is hashed and stored");
  add_case_options(*resolve_case, options->chosen_case, false);
  resolve_case->add_flag("--json", options->json, "as JSON");
  resolve_case->callback([options, &chosen] { chosen.action = [options] { return resolve(*options); }; });

  CLI::App* explain_key = group->add_subcommand("explain", "explain the options of a case");
  explain_key->add_option("key", options->key, "an option or a section; default: all")->type_name("KEY");
  CLI::Option* as_json = explain_key->add_flag("--json", options->json, "as JSON");
  explain_key->add_flag("--markdown", options->markdown, "as Markdown: the page gem/manual/keys.md")->excludes(as_json);
  explain_key->callback([options, &chosen] { chosen.action = [options] { return explain_keys(*options); }; });

  CLI::App* schema_text = group->add_subcommand("schema", "print the JSON Schema of a case");
  schema_text->callback([&chosen] {
    chosen.action = [] {
      print(json_schema());
      return 0;
    };
  });
}

}  // namespace gem
