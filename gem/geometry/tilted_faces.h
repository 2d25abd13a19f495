// Chord growth of two nearly parallel faces: the end that touches first is a corner, however small the tilt.
//
//     g = 1 / tan(tilt) + cot(beta),     tan(tilt) = |s_1 - s_0| / w
//
//   s_0, s_1  separations at the two ends of the touching stretch [m]      w  its width [m]
//   beta      angle between the contact's tangent and the other side of the corner that touches first; its cotangent is
//             negative where that side overhangs
//
// Exact for a straight face and a corner of the body that faces it. If the first end is a corner of the body that owns
// the normal, beta is taken against that normal: wrong by the tilt, which 1 / tan(tilt) outweighs by 1 / tilt^2.
// Neglected: that the chord ends beside the corner where the other face does (corners that meet end to end).
#pragma once

#include "gem/geometry/convex_contact.h"

namespace gem {

/// Signed cotangent of the side of `corner` that does not face the other body, against the contact's tangent [-];
/// `outward` is the contact normal that points out of `outline`. 0 for a side parallel to the tangent, as in
/// face_contact().
inline double cotangent_of_other_side(const Outline& outline, int corner, Vec2 outward) {
  const int before = corner > 0 ? corner - 1 : outline.count - 1;
  const bool faces_after = dot(outward, outline.normal[corner]) >= dot(outward, outline.normal[before]);
  // both directions lead away from the corner
  const Vec2 along_after = turned_left(outline.normal[corner]);
  const Vec2 along_before = -turned_left(outline.normal[before]);
  const Vec2 facing = faces_after ? along_after : along_before, other = faces_after ? along_before : along_after;
  const double rise = -dot(outward, other);
  if (!(rise > 0.0)) return 0.0;
  const Vec2 tangent = turned_left(outward);
  const double away = dot(tangent, facing) > 0.0 ? -dot(tangent, other) : dot(tangent, other);
  return away / rise;
}

/// Chord growth of a contact of two points [-]; 0 for faces exactly parallel. `normal` points from A to B; points as
/// face_contact() gives them: separations [m] and features 2 x corner + body.
inline double tilted_faces_growth(const Outline& a, const Outline& b, Vec2 normal, const ContactPoint& first,
                                  const ContactPoint& second, double width) {
  const ContactPoint& nearer = second.separation < first.separation ? second : first;
  const ContactPoint& farther = second.separation < first.separation ? first : second;
  const double gap = farther.separation - nearer.separation;
  if (!(gap > 0.0)) return 0.0;
  const bool of_b = nearer.feature % 2 == 1;
  return width / gap + cotangent_of_other_side(of_b ? b : a, nearer.feature / 2, of_b ? -normal : normal);
}

}  // namespace gem
