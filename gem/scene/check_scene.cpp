// Checks of a scene. Each rule is one small function that compares a few options and may add a problem.
#include "gem/scene/check_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/geometry/polygon.h"
#include "gem/scene/check_dp.h"
#include "gem/scene/check_drive.h"
#include "gem/scene/check_floes.h"
#include "gem/scene/check_mooring.h"
#include "gem/scene/check_platform.h"
#include "gem/scene/check_transit.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_bounds.h"
#include "gem/scene/scene_mooring.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

using List = std::vector<SceneProblem>;

// Two floes that close at speed V overlap by V dt before the contact is seen. The limit is a tenth of the smaller floe,
// well before the contact normal can flip (V dt = width).
constexpr double overlap_fraction = 0.1;
// The mooring force is split around the contact step. The split is accurate while omega dt is small.
constexpr double mooring_phase_maximum = 0.2;
constexpr double steps_maximum = 1e10;
constexpr double samples_maximum = 1e9;
constexpr double cover_maximum = 0.95;
constexpr std::size_t name_bytes_maximum = 200;
// Below this friction no pair of compact rigid bodies can jam (smallest bound over all polygons: 1.118, equilateral
// triangle).
constexpr double jamming_friction = 1.1;

std::string number(double value) { return plain_number_text(value); }

/// Four digits, for numbers that are only read.
std::string short_number(double value) { return number_text(value, 4); }

/// An upper limit with four digits, rounded down so that the printed number is allowed.
std::string limit_number(double limit) {
  const double unit = std::pow(10.0, std::floor(std::log10(limit)) - 3.0);
  return short_number(std::floor(limit / unit * (1.0 + 1e-12)) * unit);
}

bool makes_floes(const FloesDef& floes) { return is_made(floes) && (floes.count > 0 || floes.concentration > 0.0); }

void check_name(const SceneDef& s, List& out) {
  const std::string& name = s.run.name;
  bool printable = std::none_of(name.begin(), name.end(),
                                [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '/'; });
  for (std::size_t at = name.find('\xc2'); at != std::string::npos; at = name.find('\xc2', at + 1))
    printable = printable && at + 1 < name.size() && static_cast<unsigned char>(name[at + 1]) >= 0xa0;  // U+0080...
  if (name.empty() || name.size() > name_bytes_maximum || name.front() == '.' || !printable)
    out.push_back({"run.name", "not fit for a file name (value " + quoted_text(name) + ", allowed 1 to " +
                                   std::to_string(name_bytes_maximum) +
                                   " bytes without '/' and control characters, not starting with '.')"});
}

void check_step(const SceneDef& s, List& out) {
  if (!mooring_is_sound(s)) return;
  const double dt = s.numerics.time_step_s;
  const double width = smallest_floe_width(s);
  const double speed = closing_speed_bound(s);
  const double largest = overlap_fraction * width / speed;
  if (std::isfinite(width) && speed > 0.0 && dt > largest)
    out.push_back({"numerics.time_step_s", "the time step is too long for the smallest floe (value " + number(dt) +
                                               ", allowed at most " + limit_number(largest) + " s: bodies closing at " +
                                               short_number(speed) + " m/s would overlap by more than a tenth of " +
                                               short_number(width) + " m) give a smaller time step"});
  const double steps = s.run.duration_s / dt;
  if (steps > steps_maximum)
    out.push_back({"run.duration_s", "too many time steps (value " + number(s.run.duration_s) + ", allowed at most " +
                                         number(steps_maximum * dt) + " s with this time step)"});
}

void check_swing(const SceneDef& s, List& out) {
  if (!s.platform.present || s.platform.fixed || !mooring_is_sound(s)) return;
  const double omega = std::sqrt(largest_mooring_stiffness(s) / s.platform.mass_kg);
  if (omega * s.numerics.time_step_s > mooring_phase_maximum)
    out.push_back({"numerics.time_step_s",
                   "the time step is too long for the mooring (value " + number(s.numerics.time_step_s) +
                       ", allowed at most " + limit_number(mooring_phase_maximum / omega) + " s: omega dt <= " +
                       number(mooring_phase_maximum) + ") give a smaller time step or check stiffness and mass"});
}

void check_record(const SceneDef& s, List& out) {
  const auto check = [&](const char* key, double interval) {
    if (interval < s.numerics.time_step_s)
      out.push_back({key, "shorter than one time step (value " + number(interval) + ", allowed at least " +
                              number(s.numerics.time_step_s) + " s)"});
    else if (s.run.duration_s / interval > samples_maximum)
      out.push_back({key, "too many samples (value " + number(interval) + ", allowed at least " +
                              number(s.run.duration_s / samples_maximum) + " s)"});
  };
  check("output.platform_interval_s", s.output.platform_interval_s);
  check("output.floes_interval_s", s.output.floes_interval_s);
  check("output.force_window_s", s.output.force_window_s);
}

void check_sizes(const SceneDef& s, List& out) {
  const FloesDef& f = s.floes;
  if (!makes_floes(f)) return;
  if (!(f.size_minimum_m < f.size_mean_m && f.size_mean_m < f.size_maximum_m)) {
    out.push_back({"floes.size_mean_m", "not between the limits (value " + number(f.size_mean_m) +
                                            ", allowed between floes.size_minimum_m = " + number(f.size_minimum_m) +
                                            " and floes.size_maximum_m = " + number(f.size_maximum_m) + " m)"});
    return;
  }
  // On [a, b] with a given mean, the largest deviation has all weight at a and b.
  const double most = std::sqrt((f.size_mean_m - f.size_minimum_m) * (f.size_maximum_m - f.size_mean_m));
  if (f.size_deviation_m >= most)
    out.push_back({"floes.size_deviation_m", "no distribution within the limits has this deviation (value " +
                                                 number(f.size_deviation_m) + ", allowed below " + limit_number(most) +
                                                 " m with size_mean_m = " + number(f.size_mean_m) +
                                                 " between size_minimum_m = " + number(f.size_minimum_m) +
                                                 " and size_maximum_m = " + number(f.size_maximum_m) + " m)"});
  if (f.concentration > 0.0) return;
  const double mean_area = f.size_mean_m * f.size_mean_m + f.size_deviation_m * f.size_deviation_m;
  const double cover = static_cast<double>(f.count) * mean_area / (f.length_m * f.width_m);
  if (cover > cover_maximum)
    out.push_back({"floes.count",
                   "the floes do not fit into the field (value " + std::to_string(f.count) + ", they would cover " +
                       short_number(cover) +
                       " of its area; about 0.8 is the limit) lower it or enlarge floes.length_m or floes.width_m"});
}

void check_classes(const SceneDef& s, List& out) {
  if (!makes_floes(s.floes)) return;
  double sum = 0.0;
  for (const IceClassDef& c : s.floes.classes) sum += c.tenths;
  if (!(sum > 0.0) || sum > 9.0)
    out.push_back({"ice.class",
                   "the sum of the tenths of all classes is out of range (value " + number(sum) + ", allowed (0, 9])"});
  if (s.floes.classes.size() > 255)
    out.push_back(
        {"ice.class", "too many classes (value " + std::to_string(s.floes.classes.size()) + ", allowed at most 255)"});
}

void check_field_place(const SceneDef& s, List& out) {
  const FloesDef& f = s.floes;
  if (!makes_floes(f)) return;
  const double end = f.start_x_m + f.length_m;
  const double bow = s.platform.anchor_m.x + s.platform.start_offset_m.x - platform_reach(s.platform).upstream;
  if (s.platform.present && end > bow)
    out.push_back({"floes.start_x_m", "the field reaches the platform (value " + number(f.start_x_m) +
                                          ", allowed at most " + number(bow - f.length_m) + " m)"});
  if (s.boundary.present && f.start_x_m < s.boundary.inlet_x_m)
    out.push_back({"floes.start_x_m", "the field begins upstream of the boundary (value " + number(f.start_x_m) +
                                          ", allowed at least boundary.inlet_x_m = " + number(s.boundary.inlet_x_m) +
                                          " m)"});
  if (s.boundary.present && f.width_m > s.boundary.inlet_width_m)
    out.push_back({"floes.width_m",
                   "the field is wider than the channel (value " + number(f.width_m) +
                       ", allowed at most boundary.inlet_width_m = " + number(s.boundary.inlet_width_m) + " m)"});
}

void check_listed(const SceneDef& s, List& out) {
  if (s.floes.source != FloeSource::listed) return;
  for (std::size_t i = 0; i < s.floe.size(); ++i) {
    const FloeDef& floe = s.floe[i];
    const double cosine = std::cos(floe.angle_rad), sine = std::sin(floe.angle_rad);
    const PolygonMoments outline = polygon_moments(floe.outline_m);
    if (!(std::abs(outline.area) > 0.0)) continue;  // reported with its corners when the field is made
    // The centre: the origin of an outline may be anywhere, and is far away for floes of a file.
    const Vec2 c = outline.centroid;
    const Vec2 centre = floe.position_m + Vec2{cosine * c.x - sine * c.y, sine * c.x + cosine * c.y};
    const std::string name = "floe[" + std::to_string(i) + "]";
    if (!place_range.contains(centre.x) || !place_range.contains(centre.y))
      out.push_back({"floe", name + ": its centre is out of range (value " + number(centre.x) + ", " +
                                 number(centre.y) + ", allowed " + range_text(place_range, "m") + ") give it in m"});
    else if (centre.x > s.output.retire_x_m)
      out.push_back({"output.retire_x_m", name + " starts downstream of the line (value " +
                                              number(s.output.retire_x_m) + ", allowed at least " + number(centre.x) +
                                              " m)"});
  }
}

/// Catches mistaken units, mostly mm for m. Floes of a file need it too, because no range table has checked them.
void check_listed_sizes(const SceneDef& s, List& out) {
  if (s.floes.source != FloeSource::listed) return;
  const auto check = [&](std::size_t i, const char* what, double value, const Range& range) {
    if (range.contains(value)) return;
    out.push_back({"floe", "floe[" + std::to_string(i) + "]: " + what + " out of range (value " + number(value) +
                               ", allowed " + range_text(range, "m") + ") give it in m"});
  };
  for (std::size_t i = 0; i < s.floe.size(); ++i) {
    const double area = std::abs(polygon_moments(s.floe[i].outline_m).area);
    // an invalid outline is reported with its corners when the field is made
    if (area > 0.0) check(i, "size (root of the area)", std::sqrt(area), floe_size_range);
    if (s.floe[i].thickness_m > 0.0) check(i, "thickness", s.floe[i].thickness_m, thickness_range);
  }
}

void check_floating(const SceneDef& s, List& out) {
  const bool drafts = s.water.drag_law == DragLaw::quadratic && s.water.form_coefficient > 0.0;
  if (drafts && s.ice.density_kg_per_m3 >= s.water.density_kg_per_m3)
    out.push_back({"ice.density_kg_per_m3",
                   "the ice does not float (value " + number(s.ice.density_kg_per_m3) +
                       ", allowed below water.density_kg_per_m3 = " + number(s.water.density_kg_per_m3) + " kg/m3)"});
}

void check_breakup(const SceneDef& s, List& out) {
  const double least = 2.0 * s.numerics.time_step_s;
  if (s.breakup.maximum_pieces > 0 && s.breakup.load_time_s < least)
    out.push_back({"breakup.load_time_s", "shorter than two time steps (value " + number(s.breakup.load_time_s) +
                                              ", allowed from " + number(least) +
                                              " s on) raise it, or take a smaller numerics.time_step_s"});
}

}  // namespace

std::vector<SceneProblem> check_scene(const SceneDef& scene) {
  List problems;
  for (const auto rule :
       {check_name, check_step, check_swing, check_record, check_source, check_sizes, check_concentration,
        check_classes, check_field_place, check_platform, check_listed, check_listed_sizes, check_floating, check_drive,
        check_mooring, check_dp, check_breakup, check_transit})
    rule(scene, problems);
  return problems;
}

SceneDef with_listed_floes(const SceneDef& scene, std::vector<FloeDef> floes) {
  SceneDef listed = scene;
  listed.floes.source = FloeSource::listed;
  listed.floes.path.clear();
  listed.floes.time_s = 0.0;
  listed.floes.sha256.clear();
  listed.floes.concentration = 0.0;
  listed.floes.concave = ConcaveFloes::refuse;
  listed.floe = std::move(floes);
  for (const SceneProblem& problem : check_scene(listed))
    throw Error(ExitCode::scene_rejected, problem.key + ": " + problem.text);
  return listed;
}

std::vector<std::string> scene_warnings(const SceneDef& scene) {
  std::vector<std::string> warnings = scene.notes;
  const auto friction = [&](const char* key, double value) {
    if (value >= jamming_friction)
      warnings.push_back(std::string(key) + ": above the Painleve bound of compact floes (value " + number(value) +
                         ", limit " + number(jamming_friction) + ") a sliding corner may jam; then it sticks instead");
  };
  friction("ice.friction_ice", scene.ice.friction_ice);
  friction("ice.friction_structure", scene.ice.friction_structure);

  const FloesDef& f = scene.floes;
  if (is_made(f) && f.count > 0 && f.concentration == 0.0) {
    double tenths = 0.0;
    for (const IceClassDef& c : f.classes) tenths += c.tenths;
    const double mean_area = f.size_mean_m * f.size_mean_m + f.size_deviation_m * f.size_deviation_m;
    const double cover = 10.0 * static_cast<double>(f.count) * mean_area / (f.length_m * f.width_m);
    if (std::abs(cover - tenths) > 1.0)
      warnings.push_back("ice.class: the tenths differ from the cover of the field (value " + number(tenths) +
                         ", the floes cover " + number(std::round(10.0 * cover) / 10.0) +
                         " tenths) only the ratio of the tenths is used");
  }
  const FloesDef usual_floes;
  if (f.concentration > 0.0 && f.count != usual_floes.count)
    warnings.push_back("floes.count: has no effect (value " + std::to_string(f.count) +
                       ", floes.concentration sets the number of floes) remove it");
  if (!is_made(f) && f.count != usual_floes.count)
    warnings.push_back("floes.count: has no effect (value " + std::to_string(f.count) +
                       ", the floes that are given count) remove it");
  const std::vector<IceClassDef>& classes = f.classes;
  const IceClassDef usual;
  if (f.source == FloeSource::listed &&
      (classes.size() != 1 || classes[0].thickness_m != usual.thickness_m || classes[0].tenths != usual.tenths))
    warnings.push_back("ice.class: has no effect (listed floes have their own thickness_m) remove it");
  const double step = scene.numerics.time_step_s;
  const auto whole = [step](double time) { return std::abs(std::remainder(time, step)) <= 1e-9 * time; };
  const double ends = step * std::round(scene.run.duration_s / step);
  if (!whole(scene.run.duration_s))
    warnings.push_back("run.duration_s: not a whole number of time steps (value " + number(scene.run.duration_s) +
                       ") the run ends at " + number_text(ends, 9) + " s");
  if (scene.platform.present && !whole(scene.output.platform_interval_s))
    warnings.push_back("output.platform_interval_s: not a whole number of time steps (value " +
                       number(scene.output.platform_interval_s) +
                       ") samples will be uneven, and gem analyse and gem report need even ones; a time step is " +
                       number(step) + " s");
  warn_of_platform(scene, warnings);
  warn_of_drive(scene, warnings);
  warn_of_mooring(scene, warnings);
  warn_of_dp(scene, warnings);
  warn_of_transit(scene, warnings);
  return warnings;
}

}  // namespace gem
