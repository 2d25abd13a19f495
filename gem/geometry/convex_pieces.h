// Cuts a simple polygon into convex pieces, and its convex hull.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// Convex counter-clockwise pieces of a simple counter-clockwise outline; empty if it cannot be cut (corners on a
/// line). Pieces have only corners of the outline, so their areas sum up to its area but for rounding. Ears are
/// clipped, the best shaped first; then pieces are joined along diagonals while the joint is strictly convex and has at
/// most `corners_maximum` corners. O(n^2) for n corners. Sources: G. H. Meisters, Polygons have ears, Amer. Math.
/// Monthly 82 (1975) 648; S. Hertel, K. Mehlhorn, Fast triangulation of simple polygons, FCT 1983: at most four times
/// as many pieces as needed.
std::vector<std::vector<Vec2>> convex_pieces(const std::vector<Vec2>& outline, std::size_t corners_maximum);

/// The convex hull, counter-clockwise, without corners on a straight line. Source: A. M. Andrew, Inf. Process. Lett. 9
/// (1979) 216.
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

/// The first two edges of an outline that cross or touch away from a shared corner; {n, n} if it is simple.
struct CrossingEdges {
  std::size_t first, second;
};
CrossingEdges crossing_edges(const std::vector<Vec2>& outline);

}  // namespace gem
