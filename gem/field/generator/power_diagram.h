// The power diagram: every point of a region belongs to the site with the smallest |p - site|^2 - weight. Its cells
// are convex, and a larger weight makes a larger cell.
#pragma once

#include <vector>

#include "gem/base/vec2.h"
#include "gem/field/generator/convex_cut.h"
#include "gem/field/generator/outline_grid.h"

namespace gem {

struct PowerSites {
  std::vector<Vec2> position;  // [m]
  std::vector<double> weight;  // [m2], one per site
};

inline constexpr int wall_label = -1;

/// What the cells share out: a rectangle less the convex obstacles in it. World coordinates.
struct MosaicRegion {
  Box box;
  std::vector<std::vector<Vec2>> obstacles;  // counter-clockwise [m]
};

/// One cell per site; an edge's label is the site on its other side, or wall_label. A cell that meets an obstacle is
/// cut along that of the obstacle's edges which leaves most of it. Cells may be empty. Source: F. Aurenhammer, Power
/// diagrams, SIAM J. Comput. 16 (1987) 78.
std::vector<LabelledPolygon> power_diagram(const PowerSites& sites, const MosaicRegion& region);

}  // namespace gem
