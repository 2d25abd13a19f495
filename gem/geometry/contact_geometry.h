// Where two outlines touch: relative to A's centroid, normals from A to B.
#pragma once

#include "gem/base/vec2.h"

namespace gem {

/// One point of a contact.
struct ContactPoint {
  Vec2 position;            // relative to A's centroid, half-way between the two surfaces [m]
  double separation = 0.0;  // < 0: depth [m]
  int feature = 0;          // which corner touches: 2 x corner index + (0: of A, 1: of B)
};

/// Where and along which normal two outlines touch.
struct ContactGeometry {
  Vec2 normal;
  int count = 0;  // points
  ContactPoint point[2];
  double width = 0.0;   // chord or touching stretch [m]
  double growth = 0.0;  // how fast the chord of one point grows with depth: cot + cot of the angles at its ends [-];
                        // 0: flat, or two points, whose tilt only tilted_faces.h looks at
};

}  // namespace gem
