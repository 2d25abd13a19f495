// Which corners of two convex outlines may overlap the other one within a time step, and which sides they can press.
//
// Where two convex outlines overlap by little, a corner of one lies inside the other: the corner of a tip, both ends of
// a facing stretch. So a contact is a set of corners, each with the nearest side of the other outline that it can meet.
// A corner acts only while it is inside: bodies that pass each other with room to spare do not meet.
//
// A corner can have come through a side only if its own two sides lead away from it, or into it at less than 30
// degrees. So the end of a facing stretch does not press the side around the corner, past which its body already
// reaches.
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

/// A corner of an outline: its place and its flanks, the ways to its neighbours.
struct Tip {
  Vec2 at, flank[2];
  double least[2] = {0.0, 0.0};  // of a normal along the flanks, where the corner can come through its side
};
GEM_HD inline Tip tip_of(const Outline& o, int corner) {
  constexpr double steepest = 0.5;  // sine of the angle at which the flanks may lead into the side
  Tip tip;
  tip.at = o.corner[corner];
  tip.flank[0] = o.corner[corner > 0 ? corner - 1 : o.count - 1] - tip.at;
  tip.flank[1] = o.corner[corner + 1 < o.count ? corner + 1 : 0] - tip.at;
  for (int k = 0; k < 2; ++k) tip.least[k] = -steepest * length(tip.flank[k]);
  return tip;
}

/// Whether the corner can have come through a side with this outward normal.
GEM_HD inline bool can_meet(const Tip& tip, Vec2 normal) {
  return dot(normal, tip.flank[0]) >= tip.least[0] && dot(normal, tip.flank[1]) >= tip.least[1];
}

/// Whether it can have come through any side. If not, it may press all that show.
GEM_HD inline bool can_meet_any(const Surface& s, const Tip& tip) {
  for (int j = 0; j < s.outline.count; ++j)
    if (s.shows(j) && can_meet(tip, s.outline.normal[j])) return true;
  return false;
}

/// The side that a corner at `y` presses, or would: the nearest through which it can have come.
GEM_HD inline SideDistance nearest_met_side(const Surface& s, Vec2 y, const Tip& tip) {
  const bool any_met = can_meet_any(s, tip);
  SideDistance best{0, -1e300};
  for (int j = 0; j < s.outline.count; ++j) {
    const double distance = dot(s.outline.normal[j], y - s.outline.corner[j]);
    const bool meets = s.shows(j) && (!any_met || can_meet(tip, s.outline.normal[j]));
    if (meets && distance > best.distance) best = {j, distance};
  }
  return best;
}

/// Calls take(corner, outermost side) for every corner of `p` that is closer than `reach` to `q` [m]. `to_p` is the
/// vector from q's centroid to p's. `beyond`: p's corners nearer than this to q along `axis` [m] are looked at, a
/// necessary condition; `axis` points from q to p.
template <class Take>
GEM_HD inline void corners_near(const Outline& p, const Surface& q, Vec2 to_p, Vec2 axis, double beyond, double reach,
                                Take&& take) {
  for (int c = 0; c < p.count; ++c) {
    const Vec2 y = to_p + p.corner[c];
    if (!(dot(axis, y) < beyond)) continue;
    const SideDistance outer = outermost_side(q, y);
    if (outer.distance < reach) take(c, outer);
  }
}

}  // namespace gem
