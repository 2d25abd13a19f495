// Finds the corners that lie inside another outline, from the present places, by testing every corner of every pair
// against every side.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/field/bodies.h"

namespace gem::reference {

/// A corner of body p inside body q.
struct CornerInside {
  std::int32_t p = 0, q = 0;
  std::int32_t corner = 0;  // of p
  std::int32_t side = -1;   // of q, that it presses
  double depth = 0.0;       // distance from that side [m]
  Vec2 normal;              // of that side, outward
  Vec2 place;               // [m]
};

/// Two outlines that overlap; a < b.
struct Overlap {
  std::int32_t a = 0, b = 0;
  std::vector<CornerInside> corners;
  double chord = 0.0;  // longest distance between crossings of the outlines [m]
};

/// All pairs with a corner inside, ascending in (a, b). Two fixed bodies never touch.
std::vector<Overlap> all_overlaps(const Bodies& bodies);

}  // namespace gem::reference
