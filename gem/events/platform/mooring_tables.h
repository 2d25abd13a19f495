// The tables and lines of a mooring as a case gives them, and the curves that are made of them once per run.
#pragma once

#include <array>
#include <vector>

#include "gem/events/platform/catenary.h"
#include "gem/events/platform/mooring_laws.h"

namespace gem {

/// A line: anchor x, y in the world; fairlead x, y from the platform's centre, at yaw 0 [m]; length [m], weight in
/// water [N/m], axial stiffness [N], strength [N] (0: none given).
using LineRow = std::array<double, 8>;
using DirectionRow = std::array<double, 3>;  ///< direction of the offset [rad]; offset [m]; force [N]

/// What law = "table" and law = "catenary" read.
struct MooringDesign {
  std::vector<ForceRow> force = {};          ///< the same in every direction
  std::vector<DirectionRow> direction = {};  ///< by direction; rows of one direction stand together
  std::vector<LineRow> lines = {};
  double line_height_m = 0.0;  ///< of the fairleads above the anchors
};

/// The branches of a mooring and their curves. Must outlive every view.
struct MooringTables {
  std::vector<MooringBranch> branch;
  std::vector<CurveKnot> knot;

  MooringView view() const {
    return {branch.data(), knot.data(), static_cast<std::int32_t>(branch.size()),
            static_cast<std::int32_t>(knot.size())};
  }
};

/// What the shape of a line depends on.
LineProperties line_properties(const MooringDesign& design, const LineRow& row);

/// Rows of one direction.
struct DirectionGroup {
  double direction = 0.0;  // [rad]
  std::vector<ForceRow> rows;
};

/// The rows by direction, in their order.
std::vector<DirectionGroup> direction_groups(const std::vector<DirectionRow>& rows);

/// Makes the curves of a mooring. Empty for a linear one. The design must have passed the checks of the scene.
MooringTables mooring_tables(MooringLaw law, const MooringDesign& design);

}  // namespace gem
