// Contact geometry of two outlines. Positions are relative to A's centroid; normals point from A to B.
#pragma once

#include "gem/base/vec2.h"

namespace gem {

/// One point of a contact.
struct ContactPoint {
  Vec2 position;            // relative to A's centroid, half-way between both surfaces [m]
  double separation = 0.0;  // < 0: depth [m]
  int feature = 0;          // the touching corner: 2 x corner index + (0: of A, 1: of B)
};

/// Contact points and normal of two outlines.
struct ContactGeometry {
  Vec2 normal;
  int count = 0;  // number of points
  ContactPoint point[2];
  double width = 0.0;   // chord or length of the facing edges [m]
  double growth = 0.0;  // growth of the chord of one point with depth: cot + cot of the angles at its ends [-]; 0:
                        // flat, or two points (see tilted_faces.h)
};

}  // namespace gem
