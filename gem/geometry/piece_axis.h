// The contact of a piece of one rigid body with another body: along a normal of the whole outline.
#pragma once

#include "gem/geometry/face_contact.h"
#include "gem/geometry/piece_joints.h"
#include "gem/geometry/separating_axes.h"

namespace gem {

/// What the axis of a pair of a piece and another body is to the whole outline.
enum class PieceAxis {
  outer,     ///< a normal of the whole
  replaced,  ///< none; now it is the normal of the outer side that parts the bodies most
  none       ///< none, and no outer side faces the other body: another piece has the contact
};

namespace detail {

/// Whether the axis is one of the whole outline. Asks the corner or the side of the piece that meets the other body.
GEM_HD inline bool is_outer(const Outline& a, const PieceCorner* corners, Rotation rotation, const Outline& b,
                            const Separation& axis) {
  if (!axis.edge_of_b) return !corners[axis.edge].is_inside;
  const Vec2 normal = -b.normal[axis.edge];
  const PieceCorner& corner = corners[support_corner(a, -normal)];
  if (!corner.is_joint) return true;
  return corner.has_normal && corner.normals.hold(rotate({rotation.cosine, -rotation.sine}, normal));
}

}  // namespace detail

/// Looks at `axis` of the piece `a`, which is turned by `rotation`, and of `b`; `corners` are those of the piece. A
/// replaced axis holds only where both outlines face each other along the side.
GEM_HD inline PieceAxis find_outer_axis(const Outline& a, const PieceCorner* corners, Rotation rotation,
                                        const Outline& b, Vec2 offset, Separation& axis) {
  if (detail::is_outer(a, corners, rotation, b, axis)) return PieceAxis::outer;
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

/// As face_contact(), of a piece; `axis`: the best separating axis of the pair.
GEM_HD inline ContactGeometry piece_face_contact(const Outline& a, const PieceCorner* corners, Rotation rotation,
                                                 const Outline& b, Vec2 offset, Separation axis, double margin) {
  const PieceAxis is = find_outer_axis(a, corners, rotation, b, offset, axis);
  if (is == PieceAxis::none) return {};
  const ContactGeometry geometry = face_contact(a, b, offset, axis, margin);
  return is == PieceAxis::replaced && !(geometry.width > 0.0) ? ContactGeometry{} : geometry;
}

}  // namespace gem
