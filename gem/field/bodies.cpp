// Appends bodies to the arrays: recentres the outline and derives mass and inertia.
#include "gem/field/bodies.h"

#include <algorithm>

#include "gem/geometry/polygon.h"

namespace gem {
namespace {

struct MassAndInertia {
  double mass = 0.0;
  double inertia = 0.0;
};

MassAndInertia mass_and_inertia(const BodyDef& def, const PolygonMoments& moments) {
  if (def.kind == BodyKind::fixed || moments.area <= 0.0) return {};
  const double mass = def.mass > 0.0 ? def.mass : def.density * moments.area * def.thickness;
  return {mass, def.inertia > 0.0 ? def.inertia : mass * (moments.second_moment / moments.area)};
}

double append_outline(Bodies& bodies, const std::vector<Vec2>& outline, Vec2 centroid) {
  if (bodies.vertex_begin.empty()) bodies.vertex_begin.push_back(0);
  double radius = 0.0;
  for (const Vec2 p : outline) {
    bodies.vertex.push_back(p - centroid);
    radius = std::max(radius, length(p - centroid));
  }
  bodies.vertex_begin.push_back(static_cast<std::int32_t>(bodies.vertex.size()));
  return radius;
}

}  // namespace

void append(Bodies& bodies, const BodyDef& def) {
  const PolygonMoments moments = polygon_moments(def.outline);
  const MassAndInertia m = mass_and_inertia(def, moments);
  bodies.kind.push_back(def.kind);
  bodies.ice_class.push_back(def.ice_class);
  bodies.radius.push_back(append_outline(bodies, def.outline, moments.centroid));
  bodies.area.push_back(moments.area);
  bodies.thickness.push_back(def.thickness);
  bodies.mass.push_back(m.mass);
  bodies.inertia.push_back(m.inertia);
  bodies.inverse_mass.push_back(m.mass > 0.0 && !def.immovable ? 1.0 / m.mass : 0.0);
  bodies.inverse_inertia.push_back(m.inertia > 0.0 && !def.locked_yaw && !def.immovable ? 1.0 / m.inertia : 0.0);
  bodies.drag.push_back(0.0);
  bodies.spin_drag.push_back(0.0);
  bodies.position.push_back(def.origin + rotate(def.rotation, moments.centroid));
  bodies.rotation.push_back(def.rotation);
  bodies.velocity.push_back(def.velocity);
  bodies.spin.push_back(def.spin);
  bodies.active.push_back(def.outline.empty() ? 0 : 1);
}

std::int32_t platform_bodies(const Bodies& bodies) {
  const auto is_platform = [](BodyKind kind) { return kind == BodyKind::platform; };
  const auto end = std::find_if_not(bodies.kind.begin(), bodies.kind.end(), is_platform);
  return std::max(1, static_cast<std::int32_t>(end - bodies.kind.begin()));
}

void append_pieces(Bodies& bodies, const BodyDef& def, const std::vector<std::vector<Vec2>>& pieces) {
  BodyDef piece = def;
  const PolygonMoments all = moments_of_all(pieces);
  const MassAndInertia m = mass_and_inertia(def, all);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    piece.outline = pieces[i];
    append(bodies, piece);
  }
  const std::size_t count = bodies.count(), first = count - pieces.size();
  double radius = 0.0;
  for (std::size_t i = first; i < count; ++i) {
    std::int32_t v = bodies.vertex_begin[i];
    for (const Vec2 corner : pieces[i - first]) {
      bodies.vertex[static_cast<std::size_t>(v++)] = corner - all.centroid;
      radius = std::max(radius, length(corner - all.centroid));
    }
  }
  for (std::size_t i = first; i < count; ++i) {
    bodies.radius[i] = radius;
    bodies.area[i] = all.area;
    bodies.mass[i] = i == first ? m.mass : 0.0;
    bodies.inertia[i] = i == first ? m.inertia : 0.0;
    bodies.inverse_mass[i] = m.mass > 0.0 && !def.immovable ? 1.0 / m.mass : 0.0;
    bodies.inverse_inertia[i] = m.inertia > 0.0 && !def.locked_yaw && !def.immovable ? 1.0 / m.inertia : 0.0;
    bodies.position[i] = def.origin + rotate(def.rotation, all.centroid);
  }
}

std::vector<Vec2> world_outline(const Bodies& bodies, std::size_t i) {
  std::vector<Vec2> outline;
  outline.reserve(static_cast<std::size_t>(bodies.vertex_count(i)));
  for (std::int32_t v = bodies.vertex_begin[i]; v < bodies.vertex_begin[i + 1]; ++v)
    outline.push_back(bodies.position[i] + rotate(bodies.rotation[i], bodies.vertex[static_cast<std::size_t>(v)]));
  return outline;
}

}  // namespace gem
