// Each rule is one small function that compares a few options and may add a problem.
#include "gem/scene/checks/checks.h"

#include <cmath>
#include <string>

#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_mooring.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

using List = std::vector<SceneProblem>;

constexpr double half_turn = 3.14, whole_turn = 6.28;

std::string digits(double value) { return plain_number_text(value); }

/// A table of force over offset; `where` names its rows.
void check_rows(const std::string& key, const std::string& where, const std::vector<ForceRow>& rows, List& out) {
  if (rows.size() < 2) {
    out.push_back({key, "too few rows" + where + " (value " + std::to_string(rows.size()) +
                            ", allowed at least 2); give the force at two offsets or more"});
    return;
  }
  if (rows[0][1] != 0.0)
    out.push_back({key, "the force does not begin at 0" + where + " (value " + digits(rows[0][1]) +
                            " N in the first row, allowed 0); begin with the offset at which the mooring tightens"});
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (!(rows[k][0] > rows[k - 1][0])) {
      out.push_back({key, "the offsets of the rows do not rise" + where + " (value " + digits(rows[k][0]) +
                              " m, allowed above " + digits(rows[k - 1][0]) + " m); sort the rows by offset"});
      return;
    }
}

void check_directions(const std::vector<DirectionGroup>& groups, List& out) {
  const std::string key = "mooring.direction_table";
  if (groups.size() < 3) {
    out.push_back({key, "too few directions (value " + std::to_string(groups.size()) +
                            ", allowed at least 3); give more directions around the turn, or mooring.force_table"});
    return;
  }
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const bool last = k + 1 == groups.size();
    const double gap = groups[last ? 0 : k + 1].direction - groups[k].direction + (last ? whole_turn : 0.0);
    if (gap > 0.0 && gap <= half_turn) continue;
    out.push_back({key, "the directions do not go around a turn (value " + digits(gap) + " rad after " +
                            digits(groups[k].direction) + " rad, allowed above 0 and at most " + digits(half_turn) +
                            " rad); let them rise, less than half a turn apart, the last within a turn of the first"});
    return;
  }
}

void check_force_tables(const SceneDef& s, List& out) {
  const MooringDesign& d = s.mooring_design;
  if (s.mooring.law != MooringLaw::table) {
    const auto idle = [&](const char* key, bool given) {
      if (given)
        out.push_back({key, "has no effect (mooring.law is not \"table\"); set mooring.law = \"table\", or remove it"});
    };
    idle("mooring.force_table", !d.force.empty());
    idle("mooring.direction_table", !d.direction.empty());
    return;
  }
  if (d.force.empty() == d.direction.empty()) {
    out.push_back({"mooring.law", "\"table\" needs one table (value " + std::string(d.force.empty() ? "none" : "two") +
                                      "); give mooring.force_table, or mooring.direction_table"});
    return;
  }
  if (!d.force.empty()) check_rows("mooring.force_table", "", d.force, out);
  const std::vector<DirectionGroup> groups = direction_groups(d.direction);
  for (const DirectionGroup& group : groups)
    check_rows("mooring.direction_table", " of direction " + digits(group.direction) + " rad", group.rows, out);
  if (!groups.empty()) check_directions(groups, out);
}

/// One line; `name` is for the message.
void check_line(const SceneDef& s, const LineRow& row, const std::string& name, List& out) {
  const std::string key = "mooring.line_table";
  const double height = s.mooring_design.line_height_m;
  if (!(row[4] > height))
    out.push_back({key, name + " does not reach the seabed (value " + digits(row[4]) +
                            " m, allowed above mooring.line_height_m = " + digits(height) +
                            " m); give a longer line, or check the height"});
}

void check_lines(const SceneDef& s, List& out) {
  const MooringDesign& d = s.mooring_design;
  const std::string key = "mooring.line_table";
  if (s.mooring.law != MooringLaw::catenary) {
    if (!d.lines.empty() || d.line_height_m != 0.0)
      out.push_back({d.lines.empty() ? "mooring.line_height_m" : key,
                     "has no effect (mooring.law is not \"catenary\"); set mooring.law = \"catenary\", or remove it"});
    return;
  }
  if (d.lines.empty() || d.lines.size() > lines_maximum)
    out.push_back({key, "wrong number of lines (value " + std::to_string(d.lines.size()) + ", allowed 1 to " +
                            std::to_string(lines_maximum) + "); give a row for each line"});
  if (!(d.line_height_m > 0.0))
    out.push_back({"mooring.line_height_m",
                   "missing (mooring.law is \"catenary\"); give the height of the fairleads "
                   "above the seabed"});
  else
    for (std::size_t k = 0; k < d.lines.size(); ++k) check_line(s, d.lines[k], "line " + std::to_string(k + 1), out);
}

/// A line that is torn at the start, which mistaken units or places do.
void check_start(const SceneDef& s, List& out) {
  if (!s.platform.present || s.platform.fixed || s.mooring.law != MooringLaw::catenary || !mooring_is_sound(s)) return;
  const std::vector<double> tensions = line_tensions_at_start(s);
  for (std::size_t k = 0; k < tensions.size(); ++k)
    if (const double strength = s.mooring_design.lines[k][7]; strength > 0.0 && tensions[k] > strength)
      out.push_back({"mooring.line_table", "line " + std::to_string(k + 1) + " is torn at the start (value " +
                                               digits(tensions[k]) + " N, allowed at most its strength of " +
                                               digits(strength) +
                                               " N); give a longer line, or check places and height"});
}

void check_damping(const SceneDef& s, List& out) {
  if (s.mooring.law != MooringLaw::linear && s.mooring.damping_ratio != 0.0)
    out.push_back(
        {"mooring.damping_ratio", "has no effect (value " + digits(s.mooring.damping_ratio) +
                                      ", allowed only with mooring.law = \"linear\"); give mooring.damping_N_s_per_m"});
}

void check_yaw(const SceneDef& s, List& out) {
  const double stiffness = s.mooring.yaw_stiffness_N_m_per_rad;
  const double inertia = platform_inertia(s.platform);
  if (!s.platform.present || s.platform.fixed || stiffness == 0.0 || !(inertia > 0.0)) return;
  constexpr double phase_maximum = 0.2;  // as for surge and sway
  const double omega = std::sqrt(stiffness / inertia);
  if (omega * s.numerics.time_step_s > phase_maximum)
    out.push_back({"numerics.time_step_s",
                   "the time step is too long for the yaw on its mooring (value " + digits(s.numerics.time_step_s) +
                       ", allowed at most " + digits(phase_maximum / omega) +
                       " s); give a smaller time step or check mooring.yaw_stiffness_N_m_per_rad"});
}

}  // namespace

void check_mooring(const SceneDef& scene, List& problems) {
  for (const auto rule : {check_force_tables, check_lines, check_start, check_damping, check_yaw})
    rule(scene, problems);
}

bool mooring_is_sound(const SceneDef& scene) {
  List problems;
  check_force_tables(scene, problems);
  check_lines(scene, problems);
  return problems.empty();
}

void warn_of_mooring(const SceneDef& scene, std::vector<std::string>& warnings) {
  const MooringDef &m = scene.mooring, usual;
  if (m.law != MooringLaw::linear && m.stiffness_N_per_m != usual.stiffness_N_per_m)
    warnings.push_back("mooring.stiffness_N_per_m: has no effect (mooring.law is not \"linear\"); remove it");
  if (scene.platform.present && scene.platform.fixed && m.law != MooringLaw::linear)
    warnings.push_back("mooring.law: has no effect (a fixed platform needs no mooring); remove it");
  if (scene.output.line_tensions && m.law != MooringLaw::catenary)
    warnings.push_back("output.line_tensions: has no effect (mooring.law is not \"catenary\"); remove it");
  if (scene.platform.yaw == Yaw::locked && (m.yaw_stiffness_N_m_per_rad > 0.0 || m.yaw_damping_N_m_s_per_rad > 0.0))
    warnings.push_back("mooring.yaw_stiffness_N_m_per_rad: has no effect (the yaw is locked); remove it");
}

}  // namespace gem
