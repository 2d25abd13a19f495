// The facing stretch of two faces of convex outlines.
//
// Outlines are in world axes relative to their own centroids; `offset` is the vector from A's centroid to B's.
#pragma once

#include "gem/geometry/contact_geometry.h"
#include "gem/geometry/separating_axes.h"

namespace gem {

/// Returns both ends of the common part of two facing edges, if they are closer than `margin` [m]. Each end is a corner
/// of A or B, which identifies the point across time steps. Points are ordered along the normal turned left.
GEM_HD inline ContactGeometry face_contact(const Outline& a, const Outline& b, Vec2 offset, const Separation& axis,
                                           double margin) {
  // the reference outline r owns the axis, the incident outline i faces it; coordinates are relative to A's centroid
  const Outline& r = axis.edge_of_b ? b : a;
  const Outline& i = axis.edge_of_b ? a : b;
  const Vec2 to_r = axis.edge_of_b ? offset : Vec2{};
  const Vec2 to_i = axis.edge_of_b ? Vec2{} : offset;
  const int side_r = axis.edge_of_b ? 1 : 0;
  const Vec2 outward = r.normal[axis.edge];
  const Vec2 along = turned_left(outward);

  // the incident edge: of the two edges at the deepest corner, the one more parallel to the reference edge
  const int deepest = axis.corner >= 0 ? axis.corner : detail::support_corner(i, outward);
  const int before = deepest > 0 ? deepest - 1 : i.count - 1;
  const double facing_before = dot(outward, i.normal[before]);
  const double facing_after = dot(outward, i.normal[deepest]);
  const int edge = facing_before < facing_after ? before : deepest;
  const int edge_end = edge + 1 < i.count ? edge + 1 : 0;
  const int reference_end = axis.edge + 1 < r.count ? axis.edge + 1 : 0;

  // the reference edge runs along +along; the incident edge runs the opposite way
  const Vec2 p0 = to_r + r.corner[axis.edge];
  const Vec2 p1 = to_r + r.corner[reference_end];
  const Vec2 q0 = to_i + i.corner[edge_end];
  const Vec2 q1 = to_i + i.corner[edge];
  const double reach = dot(along, p1 - p0);
  const double s0 = dot(along, q0 - p0);
  const double s1 = dot(along, q1 - p0);
  const double d0 = dot(outward, q0 - p0);
  const double d1 = dot(outward, q1 - p0);

  const double span = s1 - s0;
  // low end: the larger of both starts; high end: the smaller of both ends
  const bool low_is_incident = !(s0 < 0.0) || !(span > 0.0);
  const bool high_is_incident = !(s1 > reach) || !(span > 0.0);
  const double low_depth = low_is_incident ? d0 : d0 + (d1 - d0) * ((0.0 - s0) / span);
  const double high_depth = high_is_incident ? d1 : d0 + (d1 - d0) * ((reach - s0) / span);
  const Vec2 low = low_is_incident ? q0 - (0.5 * d0) * outward : p0 + (0.5 * low_depth) * outward;
  const Vec2 high = high_is_incident ? q1 - (0.5 * d1) * outward : p1 + (0.5 * high_depth) * outward;
  const ContactPoint low_end{low, low_depth, low_is_incident ? 2 * edge_end + (1 - side_r) : 2 * axis.edge + side_r};
  const ContactPoint high_end{high, high_depth,
                              high_is_incident ? 2 * edge + (1 - side_r) : 2 * reference_end + side_r};

  const Vec2 normal = axis.edge_of_b ? -outward : outward;
  const double low_s = low_is_incident ? s0 : 0.0;
  const double high_s = high_is_incident ? s1 : reach;
  const bool stretch = span > 0.0 && high_s > low_s;
  const double width = stretch ? high_s - low_s : 0.0;
  const bool low_touches = low_depth < margin, high_touches = high_depth < margin;
  // order along the normal turned left, which is -along if B is the reference
  if (stretch && low_touches && high_touches)
    return axis.edge_of_b ? ContactGeometry{normal, 2, {high_end, low_end}, width, 0.0}
                          : ContactGeometry{normal, 2, {low_end, high_end}, width, 0.0};
  // chord growth at the deepest corner: cotangents of its two sides relative to the reference edge
  const Vec2 side_before = turned_left(i.normal[before]);
  const Vec2 side_after = turned_left(i.normal[deepest]);
  const double rise_before = -dot(outward, side_before);
  const double rise_after = dot(outward, side_after);
  double growth = 0.0;
  if (rise_before > 0.0) growth += -dot(along, side_before) / rise_before;
  if (rise_after > 0.0) growth += -dot(along, side_after) / rise_after;
  if (stretch)
    return {normal, low_touches || high_touches ? 1 : 0, {low_touches ? low_end : high_end, high_end}, width, growth};
  // no common part (corner against corner): only the deepest corner touches
  const Vec2 corner = to_i + i.corner[deepest];
  const ContactPoint at_corner{corner - (0.5 * axis.distance) * outward, axis.distance, 2 * deepest + (1 - side_r)};
  return {normal, axis.distance < margin ? 1 : 0, {at_corner, {}}, width, growth};
}

}  // namespace gem
