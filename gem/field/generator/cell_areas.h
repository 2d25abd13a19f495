// Weights of a power diagram whose cells have the asked areas.
#pragma once

#include <vector>

#include "gem/field/generator/power_diagram.h"

namespace gem {

/// A power diagram with its cells and their areas.
struct Diagram {
  PowerSites sites;
  std::vector<LabelledPolygon> cells;
  std::vector<double> area;  // [m2]
};

Diagram make_diagram(PowerSites sites, const MosaicRegion& region);

/// One damped Newton step towards cells whose areas have the ratios of `wanted`. Returns the largest relative error of
/// an area before the step. The areas depend on the weights through a graph Laplacian: d area_i / d weight_j =
/// -edge_ij / (2 distance_ij).
/// Source: J. Kitagawa, Q. Merigot, B. Thibert, Convergence of a Newton algorithm for semi-discrete optimal transport,
/// J. Eur. Math. Soc. 21 (2019) 2603.
double step_to_areas(Diagram& diagram, const MosaicRegion& region, const std::vector<double>& wanted);

/// Moves every site to the centroid of its cell, or half the way if a cell would vanish.
void centre_sites(Diagram& diagram, const MosaicRegion& region);

}  // namespace gem
