// Makes the curves of a mooring from its tables and lines.
#include "gem/events/platform/mooring_tables.h"

#include "gem/base/strict_math.h"

namespace gem {
namespace {

/// Adds a branch with its curve.
void add(MooringTables& tables, MooringBranch branch, const std::vector<CurveKnot>& curve) {
  branch.first_knot = static_cast<std::int32_t>(tables.knot.size());
  branch.knots = static_cast<std::int32_t>(curve.size());
  tables.branch.push_back(branch);
  tables.knot.insert(tables.knot.end(), curve.begin(), curve.end());
}

MooringTables force_tables(const MooringDesign& design) {
  MooringTables tables;
  if (!design.force.empty()) add(tables, {}, linear_curve(design.force));
  for (const DirectionGroup& group : direction_groups(design.direction)) {
    const Rotation q = strict::rotation_of_angle(group.direction);
    MooringBranch branch;
    branch.direction = {q.cosine, q.sine};
    add(tables, branch, linear_curve(group.rows));
  }
  return tables;
}

MooringTables line_tables(const MooringDesign& design) {
  MooringTables tables;
  for (const LineRow& row : design.lines) {
    MooringBranch branch;
    branch.anchor = {row[0], row[1]};
    branch.fairlead = {row[2], row[3]};
    branch.strength = row[7];
    add(tables, branch, smooth_curve(line_samples(line_properties(design, row), 1.5 * row[7])));
  }
  return tables;
}

}  // namespace

LineProperties line_properties(const MooringDesign& design, const LineRow& row) {
  return {row[4], row[5], row[6], design.line_height_m};
}

std::vector<DirectionGroup> direction_groups(const std::vector<DirectionRow>& rows) {
  std::vector<DirectionGroup> groups;
  for (const DirectionRow& row : rows) {
    if (groups.empty() || groups.back().direction != row[0]) groups.push_back({row[0], {}});
    groups.back().rows.push_back({row[1], row[2]});
  }
  return groups;
}

MooringTables mooring_tables(MooringLaw law, const MooringDesign& design) {
  if (law == MooringLaw::table) return force_tables(design);
  return law == MooringLaw::catenary ? line_tables(design) : MooringTables{};
}

}  // namespace gem
