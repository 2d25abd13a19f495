// Chord growth of two nearly parallel faces. The end that touches first is a corner, however small the tilt is.
//
//     g = cot(tilt) - cot(tilt + corner),     tan(tilt) = |s_1 - s_0| / w
//
//   s_0, s_1  separations at the two ends of the facing stretch [m]      w  its width [m]
//   corner    inner angle of the corner that touches first. One side of it leaves the other body's face by the
//             tilt, the other side by tilt + corner
//
// Exact for a straight face and a corner of either body; positive for any corner angle. Neglected: the end of the chord
// where the other face ends beside the corner (corners that meet end to end).
#pragma once

#include "gem/geometry/convex_contact.h"

namespace gem {

/// Chord growth of a contact with two points [-]. 0 for exactly parallel faces, also if the other side of the corner
/// lies on the other body's face. Points as from face_contact(): separations [m] and features 2 x corner + body.
inline double tilted_faces_growth(const Outline& a, const Outline& b, const ContactPoint& first,
                                  const ContactPoint& second, double width) {
  const ContactPoint& nearer = second.separation < first.separation ? second : first;
  const ContactPoint& farther = second.separation < first.separation ? first : second;
  const double gap = farther.separation - nearer.separation;
  if (!(gap > 0.0)) return 0.0;
  const Outline& outline = nearer.feature % 2 == 1 ? b : a;
  const int corner = nearer.feature / 2, before = corner > 0 ? corner - 1 : outline.count - 1;
  const double sine = cross(outline.normal[before], outline.normal[corner]);
  const double cosine = -dot(outline.normal[before], outline.normal[corner]);
  const double tangent = gap / width;
  const double rise = sine + tangent * cosine;  // proportional to sin(tilt + corner)
  if (!(rise > 0.0)) return 0.0;
  return width / gap - (cosine - tangent * sine) / rise;
}

}  // namespace gem
