// Which corners of two convex outlines may overlap the other one within a time step, and how deep a corner is inside.
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

/// Whether a corner with these flanks (to its neighbours) can have come through a side with this outward normal.
GEM_HD inline bool can_meet(const Vec2 flank[2], Vec2 normal) {
  constexpr double steepest = 0.5;  // sine of the angle at which the flanks may lead into the side
  return dot(normal, flank[0]) >= -steepest * length(flank[0]) && dot(normal, flank[1]) >= -steepest * length(flank[1]);
}

/// A side that a corner may cross within a time step.
struct NearSide {
  Vec2 normal;
  double offset = 0.0;    // of the side along its normal, from the centroid [m]
  double distance = 0.0;  // of the corner outside it at the start [m]
  std::int32_t side = 0;
  bool meets = false;  // the corner may touch it; else it only bounds the outline
};

/// The sides near a corner, outermost first.
struct NearSides {
  static constexpr int most = 6;
  NearSide side[most];
  int count = 0;

  GEM_HD void add(const NearSide& one) {
    if (count == most && side[most - 1].distance >= one.distance) return;
    int at = count < most ? count++ : most - 1;
    for (; at > 0 && side[at - 1].distance < one.distance; --at) side[at] = side[at - 1];
    side[at] = one;
  }
};

/// The sides that a corner at `y` may cross or press when it moves by up to `reach` [m]. If it can have come through
/// none, it may press all that show.
GEM_HD inline NearSides near_sides(const Surface& s, Vec2 y, const Vec2 flank[2], double reach) {
  constexpr double none = -1e300;
  double of_met = none, of_shown = none;
  for (int j = 0; j < s.outline.count; ++j) {
    if (!s.shows(j)) continue;
    const double distance = dot(s.outline.normal[j], y - s.outline.corner[j]);
    of_shown = larger(of_shown, distance);
    if (can_meet(flank, s.outline.normal[j])) of_met = larger(of_met, distance);
  }
  const bool meets_any = of_met > none;
  const double nearest = meets_any ? of_met : of_shown;
  NearSides near;
  for (int j = 0; j < s.outline.count; ++j) {
    const Vec2 normal = s.outline.normal[j];
    const double distance = dot(normal, y - s.outline.corner[j]);
    const bool meets = distance >= nearest - 2.0 * reach && s.shows(j) && (!meets_any || can_meet(flank, normal));
    if (meets || distance > -reach) near.add({normal, dot(normal, s.outline.corner[j]), distance, j, meets});
  }
  return near;
}

/// Where two corners are side by side, as those of aligned faces, the one of the pair's second body presses: it counts
/// as inside up to this distance beyond another side, the other one only that far within [m].
inline constexpr double tie = 1e-9;

/// The side that a corner presses, as its place in `near`; side < 0: it is not inside. `slack`: tie or -tie.
GEM_HD inline SideDistance nearest_side(const NearSides& near, Vec2 y, double slack) {
  SideDistance best{-1, -1e300};
  int outside = -1;
  for (int k = 0; k < near.count; ++k) {
    const NearSide& one = near.side[k];
    const double distance = dot(one.normal, y) - one.offset;
    if (!(distance < slack)) {
      if (outside >= 0 || !(distance < tie)) return {};
      outside = k;
    }
    if (one.meets && distance > best.distance) best = {k, distance};
  }
  return best.distance < 0.0 && (outside < 0 || outside == best.side) ? best : SideDistance{};
}

/// Where a stretch `flank` that begins at `y`, inside the outline, leaves it through a side that shows, as a share of
/// its length; 1: nowhere. `side`: where it probably does.
GEM_HD inline double exit_of(const Surface& s, int side, Vec2 y, Vec2 flank) {
  const Outline& o = s.outline;
  const Vec2 normal = o.normal[side], begin = o.corner[side], end = o.corner[side + 1 < o.count ? side + 1 : 0];
  const double room = dot(normal, begin - y), rise = dot(normal, flank);
  if (room < rise) {
    // a crossing with the line of the side is one with the outline if it is between the ends of the side
    const double share = room / rise;
    const Vec2 x = y + share * flank;
    if (dot(end - begin, x - begin) >= 0.0 && dot(end - begin, x - end) <= 0.0) return share;
  }
  double share = 1.0;
  for (int j = 0; j < o.count; ++j) {
    if (!s.shows(j)) continue;
    const double room_j = dot(o.normal[j], o.corner[j] - y), rise_j = dot(o.normal[j], flank);
    if (rise_j > 0.0 && room_j < share * rise_j) share = larger(0.0, room_j / rise_j);
  }
  return share;
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
