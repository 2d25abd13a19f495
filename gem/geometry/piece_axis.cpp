// Asks the corner or the side of the piece that meets the other body.
#include "gem/geometry/piece_axis.h"

namespace gem {
namespace {

/// Whether the axis is one of the whole outline.
bool is_outer(const Outline& a, const PieceCorner* corners, Rotation rotation, const Outline& b,
              const Separation& axis) {
  if (!axis.edge_of_b) return !corners[axis.edge].is_inside;
  const Vec2 normal = -b.normal[axis.edge];
  const PieceCorner& corner = corners[detail::support_corner(a, -normal)];
  if (!corner.is_joint) return true;
  return corner.has_normal && corner.normals.hold(rotate({rotation.cosine, -rotation.sine}, normal));
}

}  // namespace

PieceAxis find_outer_axis(const Outline& a, const PieceCorner* corners, Rotation rotation, const Outline& b,
                          Vec2 offset, Separation& axis) {
  if (is_outer(a, corners, rotation, b, axis)) return PieceAxis::outer;
  bool found = false;
  for (int edge = 0; edge < a.count; ++edge) {
    // a floe whose centre is inside the line of a side faces another one
    if (corners[edge].is_inside || !(dot(a.normal[edge], offset - a.corner[edge]) > 0.0)) continue;
    const double distance = edge_separation(a, edge, b, offset);
    if (found && !(distance > axis.distance)) continue;
    axis = {distance, edge, false};
    found = true;
  }
  return found ? PieceAxis::replaced : PieceAxis::none;
}

}  // namespace gem
