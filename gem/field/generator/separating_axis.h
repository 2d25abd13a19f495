// The axis along which two convex outlines are farthest apart or overlap least.
#pragma once

#include <limits>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// Negative separation is the overlap depth. Positive separation is at most the distance, and less where corner faces
/// corner.
struct SeparatingAxis {
  double separation = -std::numeric_limits<double>::infinity();  // [m]
  Vec2 normal;                                                   // unit, from a to b
  Vec2 point;                                                    // the corner nearest to the other outline, world [m]
};

namespace detail {

inline bool improve_axis(SeparatingAxis& best, const std::vector<Vec2>& a, const std::vector<Vec2>& b, bool swapped,
                         double enough) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 edge = a[(i + 1) % a.size()] - a[i];
    const Vec2 outward = turned_right(edge);
    double smallest = std::numeric_limits<double>::infinity();
    Vec2 corner;
    for (const Vec2 p : b) {
      const double d = dot(p - a[i], outward);
      if (d < smallest) {
        smallest = d;
        corner = p;
      }
    }
    const double scale = 1.0 / length(edge);
    if (smallest * scale > best.separation) best = {smallest * scale, scale * (swapped ? -outward : outward), corner};
    if (best.separation >= enough) return true;
  }
  return false;
}

}  // namespace detail

/// Stops early once the outlines are at least `enough` apart.
inline SeparatingAxis separating_axis(const std::vector<Vec2>& a, const std::vector<Vec2>& b,
                                      double enough = std::numeric_limits<double>::infinity()) {
  SeparatingAxis best;
  if (!detail::improve_axis(best, a, b, false, enough)) detail::improve_axis(best, b, a, true, enough);
  return best;
}

}  // namespace gem
