// The search is the reference's own: every pair, every edge against every corner. Chord and facing stretch are part of
// the laws and come from gem/geometry, which is tested against closed forms and Clipper.
#include "gem/engine/reference/touch.h"

namespace gem::reference {
namespace {

/// The edge that parts the outlines most, or is the least deep; A's first edge wins a tie.
Separation separating_axis(const Outline& a, const Outline& b, Vec2 offset) {
  Separation best;
  best.distance = -std::numeric_limits<double>::infinity();
  for (int edge = 0; edge < a.count; ++edge) {
    const double distance = edge_separation(a, edge, b, offset);
    if (distance > best.distance) best = {distance, edge, false};
  }
  for (int edge = 0; edge < b.count; ++edge) {
    const double distance = edge_separation(b, edge, a, -offset);
    if (distance > best.distance) best = {distance, edge, true};
  }
  return best;
}

/// Whether both bodies are active, at least one can move, and they are not two pieces of the platform.
bool may_touch(const Bodies& b, std::size_t i, std::size_t j) {
  return b.active[i] && b.active[j] && b.kind[j] != BodyKind::platform &&
         (b.inverse_mass[i] > 0.0 || b.inverse_mass[j] > 0.0);
}

Touch touch_of(std::size_t a, std::size_t b, const ContactGeometry& geometry, Vec2 offset) {
  Touch touch;
  touch.a = static_cast<std::int32_t>(a);
  touch.b = static_cast<std::int32_t>(b);
  touch.normal = geometry.normal;
  touch.width = geometry.width;
  touch.growth = geometry.growth;
  for (int k = 0; k < geometry.count; ++k) {
    TouchPoint point;
    point.arm_a = geometry.point[k].position;
    point.arm_b = geometry.point[k].position - offset;
    point.separation = geometry.point[k].separation;
    point.feature = geometry.point[k].feature;
    touch.points.push_back(point);
  }
  return touch;
}

}  // namespace

TurnedOutline turned_outline(const Bodies& bodies, std::size_t i) {
  TurnedOutline outline;
  const int count = bodies.vertex_count(i);
  const Vec2* const vertex = bodies.vertex.data() + bodies.vertex_begin[i];
  for (int v = 0; v < count; ++v) {
    const Vec2 edge = vertex[(v + 1) % count] - vertex[v];
    outline.corner.push_back(rotate(bodies.rotation[i], vertex[v]));
    outline.normal.push_back(rotate(bodies.rotation[i], (1.0 / length(edge)) * turned_right(edge)));
  }
  return outline;
}

std::vector<Touch> all_touches(const Bodies& bodies, const std::vector<PieceCorner>& corners, Manifold manifold,
                               double margin) {
  std::vector<TurnedOutline> outline;
  for (std::size_t i = 0; i < bodies.count(); ++i) outline.push_back(turned_outline(bodies, i));
  std::vector<Touch> touches;
  for (std::size_t a = 0; a < bodies.count(); ++a)
    for (std::size_t b = a + 1; b < bodies.count(); ++b) {
      if (!may_touch(bodies, a, b)) continue;
      const Vec2 offset = bodies.position[b] - bodies.position[a];
      const double reach = bodies.radius[a] + bodies.radius[b] + margin;
      if (dot(offset, offset) > reach * reach) continue;
      const Outline view_a = outline[a].view(), view_b = outline[b].view();
      Separation axis = separating_axis(view_a, view_b, offset);
      if (!(axis.distance < margin)) continue;
      PieceAxis is = PieceAxis::outer;
      if (!corners.empty() && bodies.kind[a] == BodyKind::platform && manifold == Manifold::chord_ends)
        is = find_outer_axis(view_a, &corners[static_cast<std::size_t>(bodies.vertex_begin[a])], bodies.rotation[a],
                             view_b, offset, axis);
      if (is == PieceAxis::none) continue;
      const ContactGeometry geometry = manifold == Manifold::chord_middle
                                           ? chord_contact(view_a, view_b, offset, axis)
                                           : face_contact(view_a, view_b, offset, axis, margin);
      if (is == PieceAxis::replaced && !(geometry.width > 0.0)) continue;
      if (geometry.count > 0) touches.push_back(touch_of(a, b, geometry, offset));
    }
  return touches;
}

}  // namespace gem::reference
