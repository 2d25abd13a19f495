// Each rule is one small function that compares a few options and may add a problem.
#include "gem/scene/checks/checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_drive.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

using List = std::vector<SceneProblem>;

void check_times(const std::string& key, const std::vector<TimeRow>& table, List& out) {
  for (std::size_t k = 1; k < table.size(); ++k)
    if (!(table[k][0] > table[k - 1][0])) {
      out.push_back({key, "the times of the rows do not rise (value " + plain_number_text(table[k][0]) + " s in row " +
                              std::to_string(k + 1) + ", allowed above " + plain_number_text(table[k - 1][0]) +
                              " s); sort the rows by time, one for each time"});
      return;
    }
}

void check_tables(const SceneDef& s, List& out) {
  const DriveDef& d = s.drive;
  check_times("current.velocity_table", d.current_velocity, out);
  check_times("current.direction_table", d.current_direction, out);
  check_times("wind.velocity_table", d.wind_velocity, out);
  check_times("wind.direction_table", d.wind_direction, out);
  const auto check_one = [&](const std::string& section, bool both) {
    if (both)
      out.push_back({section + ".direction_table", "so does " + section +
                                                       ".velocity_table (both give the velocity over time); give only "
                                                       "one of the two tables"});
  };
  check_one("current", !d.current_velocity.empty() && !d.current_direction.empty());
  check_one("wind", !d.wind_velocity.empty() && !d.wind_direction.empty());
}

/// Without drag of the water on the same area nothing bounds the speed at which the wind drives small or thin floes.
void check_wind(const SceneDef& s, List& out) {
  if (!has_wind(s)) return;
  if (s.water.drag_law != DragLaw::quadratic) {
    out.push_back({"water.drag_law",
                   "does not hold floes against the wind (wind needs \"quadratic\": both drags then have one law, and "
                   "their ratio bounds the speed); set it to \"quadratic\", or take the wind out"});
    return;
  }
  const auto held = [&](const char* key, double water, double air) {
    if (air > 0.0 && !(water > 0.0))
      out.push_back({key,
                     "does not hold floes against the wind (value 0, allowed above 0 where the wind has the same "
                     "kind of drag); give the coefficient of the water"});
  };
  held("water.skin_coefficient", s.water.skin_coefficient, s.wind.skin_coefficient);
  held("water.form_coefficient", s.water.form_coefficient, s.wind.form_coefficient);
  if (s.ice.density_kg_per_m3 >= s.water.density_kg_per_m3)
    out.push_back({"ice.density_kg_per_m3",
                   "the ice has no freeboard for the wind (value " + plain_number_text(s.ice.density_kg_per_m3) +
                       ", allowed below water.density_kg_per_m3 = " + plain_number_text(s.water.density_kg_per_m3) +
                       " kg/m3)"});
}

void check_turning(const SceneDef& s, List& out) {
  if (s.water.turning_rad != 0.0 && s.water.drag_law != DragLaw::quadratic)
    out.push_back({"water.turning_rad", "has no effect (value " + plain_number_text(s.water.turning_rad) +
                                            ", allowed only with water.drag_law = \"quadratic\"); set it to 0 or "
                                            "change the law"});
}

}  // namespace

void check_drive(const SceneDef& scene, List& problems) {
  for (const auto rule : {check_tables, check_wind, check_turning}) rule(scene, problems);
}

namespace {

/// Whether a ray from `place` along `way` meets the field, which is `reach` larger on each side.
bool meets_field(const FloesDef& floes, double reach, Vec2 place, Vec2 way) {
  double first = 0.0, last = HUGE_VAL;  // the part of the ray inside
  const auto clip = [&](double at, double speed, double low, double high) {
    if (speed == 0.0) {
      if (at < low || at > high) last = -1.0;
      return;
    }
    const double a = (low - at) / speed, b = (high - at) / speed;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  };
  clip(place.x, way.x, floes.start_x_m - reach, floes.start_x_m + floes.length_m + reach);
  clip(place.y, way.y, -0.5 * floes.width_m - reach, 0.5 * floes.width_m + reach);
  return first <= last;
}

/// Whether a generated field drifts along a straight line: the current is steady and alone. Coriolis force and a turned
/// drag bend the path of a floe until it has the speed of the water.
bool drifts_straight(const SceneDef& scene) {
  return !varies(scene.drive) && !has_wind(scene) && length(scene.current.velocity_m_per_s) > 0.0 &&
         scene.coriolis.parameter_per_s == 0.0 && scene.water.turning_rad == 0.0;
}

void warn_of_drift(const SceneDef& scene, std::vector<std::string>& warnings) {
  const Vec2 current = scene.current.velocity_m_per_s;
  if (!drifts_straight(scene) || !scene.platform.present || in_transit(scene.transit) || !is_made(scene.floes) ||
      scene.water.drag_law == DragLaw::none)
    return;
  const Vec2 place = scene.platform.anchor_m + scene.platform.start_offset_m;
  if (meets_field(scene.floes, platform_radius(scene.platform), place, -1.0 * current)) return;
  warnings.push_back("current.velocity_m_per_s: it carries the ice past the platform or away from it (value " +
                     pair_text(current) + ", the field begins at x " + plain_number_text(scene.floes.start_x_m) +
                     " m and ends at " + plain_number_text(scene.floes.start_x_m + scene.floes.length_m) +
                     " m); turn it round, or move the field with floes.start_x_m");
}

}  // namespace

void warn_of_drive(const SceneDef& scene, std::vector<std::string>& warnings) {
  const DriveDef& d = scene.drive;
  const double end = d.start_time_s + scene.run.duration_s;
  const auto look_at = [&](const std::string& key, const std::vector<TimeRow>& table) {
    if (table.empty() || (table.front()[0] <= d.start_time_s && table.back()[0] >= end)) return;
    warnings.push_back(key + ": does not cover the run (value " + plain_number_text(table.front()[0]) + " to " +
                       plain_number_text(table.back()[0]) + " s, the run takes " + plain_number_text(d.start_time_s) +
                       " to " + plain_number_text(end) + " s); its first or last row holds outside");
  };
  look_at("current.velocity_table", d.current_velocity);
  look_at("current.direction_table", d.current_direction);
  look_at("wind.velocity_table", d.wind_velocity);
  look_at("wind.direction_table", d.wind_direction);
  if (!varies(d) && d.start_time_s != 0.0)
    warnings.push_back("run.table_time_s: has no effect (there is no table); remove it");
  const EventDefinitions usual;
  const bool table = !d.current_velocity.empty() || !d.current_direction.empty();
  const Vec2 steady = scene.current.velocity_m_per_s, none = usual.current.velocity_m_per_s;
  if (table && (steady.x != none.x || steady.y != none.y))
    warnings.push_back("current.velocity_m_per_s: has no effect (the table of the current holds); remove it");
  warn_of_drift(scene, warnings);
  if (scene.wind.platform_area_m2 > 0.0 && !has_wind(scene))
    warnings.push_back(
        "wind.platform_area_m2: has no effect (there is no wind); give wind.velocity_m_per_s or a table");
}

}  // namespace gem
