// Which corners of two convex outlines may overlap the other one within a time step, and how deep a corner is inside.
//
// Where two convex outlines overlap by little, a corner of one lies inside the other: the corner of a tip, both ends of
// a facing stretch. So a contact is a set of corners, each with the nearest side of the other outline. A corner acts
// only while it is inside: bodies that pass each other with room to spare do not meet.
//
// Outlines are in world axes relative to their own centroids.
#pragma once

#include <cstdint>

#include "gem/base/choose.h"
#include "gem/geometry/separating_axes.h"

namespace gem {

/// An outline whose sides may lie inside another piece of the same body; these bound it, but are not its surface.
struct Surface {
  Outline outline;
  const std::uint8_t* hidden = nullptr;  // per side; null: none

  GEM_HD bool shows(int side) const { return !hidden || !hidden[side]; }
};

/// A side and the distance outside it [m]; < 0: depth inside.
struct SideDistance {
  int side = -1;
  double distance = 0.0;
};

/// The side of `s` that is farthest inside of the point `y` (relative to the centroid), with that distance.
GEM_HD inline SideDistance outermost_side(const Surface& s, Vec2 y) {
  SideDistance best{0, -1e300};
  for (int j = 0; j < s.outline.count; ++j) {
    const double distance = dot(s.outline.normal[j], y - s.outline.corner[j]);
    if (distance > best.distance) best = {j, distance};
  }
  return best;
}

/// Whether one of the corner's own sides goes into the outline steeper than 30 degrees behind a side with this normal:
/// the corner came past the end of that side, not through it.
GEM_HD inline bool goes_deeper(const Vec2 flank[2], Vec2 normal) {
  constexpr double steep = 0.25;  // sine of the angle, squared
  for (int k = 0; k < 2; ++k) {
    const double fall = -dot(normal, flank[k]);
    if (fall > 0.0 && fall * fall > steep * dot(flank[k], flank[k])) return true;
  }
  return false;
}

/// The visible side of the outline that a corner at `y` presses: the nearest through which it may have come, else the
/// nearest. `flank`: from the corner to its neighbours; `slack`: the corner counts as inside the other sides up to this
/// distance [m]. side < 0: it is not inside.
GEM_HD inline SideDistance pressed_side(const Surface& s, Vec2 y, const Vec2 flank[2], double slack) {
  SideDistance best{-1, -1e300}, nearest{-1, -1e300};
  int outside = -1;
  for (int j = 0; j < s.outline.count; ++j) {
    const Vec2 normal = s.outline.normal[j];
    const double distance = dot(normal, y - s.outline.corner[j]);
    if (!(distance < slack)) {
      if (outside >= 0) return {};
      outside = j;
    }
    if (!s.shows(j)) continue;
    if (distance > nearest.distance) nearest = {j, distance};
    if (distance > best.distance && !goes_deeper(flank, normal)) best = {j, distance};
  }
  if (best.side < 0) best = nearest;
  if (!(best.distance < 0.0) || (outside >= 0 && outside != best.side)) return {};
  return best;
}

/// Where the two sides of a corner at `y` leave the outline, as shares of their lengths; 1: the other end is inside too.
struct Exits {
  double share[2] = {1.0, 1.0};
};

/// `flank`: from the corner to its two neighbours [m]. They leave through visible sides only.
GEM_HD inline Exits exits(const Surface& s, Vec2 y, const Vec2 flank[2]) {
  const Outline& o = s.outline;
  Exits e;
  for (int j = 0; j < o.count; ++j) {
    if (!s.shows(j)) continue;
    const Vec2 normal = o.normal[j];
    const double room = dot(normal, o.corner[j] - y);
    for (int k = 0; k < 2; ++k) {
      const double rise = dot(normal, flank[k]);
      if (rise > 0.0 && room < e.share[k] * rise) e.share[k] = room / rise;
    }
  }
  return e;
}

/// Calls take(corner, side) for every corner of `p` that is closer than `reach` to `q` [m]. `to_p` is the vector from
/// q's centroid to p's. `beyond`: p's corners nearer than this to q along `axis` [m] are looked at, a necessary
/// condition; `axis` points from q to p.
template <class Take>
GEM_HD inline void corners_near(const Outline& p, const Surface& q, Vec2 to_p, Vec2 axis, double beyond, double reach,
                                Take&& take) {
  for (int c = 0; c < p.count; ++c) {
    const Vec2 y = to_p + p.corner[c];
    if (!(dot(axis, y) < beyond)) continue;
    const SideDistance outer = outermost_side(q, y);
    if (outer.distance < reach) take(c, outer.side);
  }
}

}  // namespace gem
