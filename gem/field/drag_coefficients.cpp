// Drag coefficients of the floes from their outlines.
#include "gem/field/drag_coefficients.h"

#include <cmath>

#include "gem/base/strict_math.h"

namespace gem {
namespace {

/// One edge seen from the origin: the distance of its line, and where the edge starts and ends on that line.
struct Edge {
  double distance = 0.0;  // positive if the edge runs counter-clockwise about the origin [m]
  double start = 0.0;     // from the foot of the perpendicular from the origin [m]
  double end = 0.0;
};

Edge edge_of(const std::vector<Vec2>& outline, std::size_t i) {
  const Vec2 a = outline[i];
  const Vec2 b = outline[(i + 1) % outline.size()];
  const Vec2 along = (1.0 / length(b - a)) * (b - a);
  return {cross(a, along), dot(a, along), dot(b, along)};
}

double strict_asinh(double x) {
  const double size = strict::log(std::fabs(x) + std::sqrt(x * x + 1.0));
  return x < 0.0 ? -size : size;
}

/// Antiderivative of (d^2 + s^2)^(3/2) in s.
double primitive(double d, double s) {
  const double r = std::sqrt(d * d + s * s);
  return s * r * (2.0 * s * s + 5.0 * d * d) / 8.0 + 3.0 / 8.0 * d * d * d * d * strict_asinh(s / d);
}

std::vector<Vec2> local_outline(const Bodies& bodies, std::size_t i) {
  return {bodies.vertex.begin() + bodies.vertex_begin[i], bodies.vertex.begin() + bodies.vertex_begin[i + 1]};
}

void set_quadratic(Bodies& bodies, std::size_t i, const SceneDef& scene) {
  const WaterDef& water = scene.water;
  const double area = bodies.area[i];
  const double draft = bodies.thickness[i] * scene.ice.density_kg_per_m3 / water.density_kg_per_m3;
  const double form = 0.5 * water.form_coefficient * draft;
  bodies.drag[i] =
      water.density_kg_per_m3 * (form * std::sqrt(area) + water.skin_coefficient * area) * bodies.inverse_mass[i];
  if (!water.spin_drag) return;
  const std::vector<Vec2> outline = local_outline(bodies, i);
  const double moment = water.skin_coefficient * integral_r3(outline) + form * edge_integral_s3(outline);
  bodies.spin_drag[i] = water.density_kg_per_m3 * moment / bodies.inertia[i];
}

}  // namespace

double integral_r3(const std::vector<Vec2>& outline) {
  // The triangle (origin, edge) in polar coordinates: r^5/5 d(angle), with d(angle) = d ds / r^2.
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge edge = edge_of(outline, i);
    const double d = std::fabs(edge.distance);
    if (d == 0.0) continue;
    sum += edge.distance / 5.0 * (primitive(d, edge.end) - primitive(d, edge.start));
  }
  return sum;
}

double edge_integral_s3(const std::vector<Vec2>& outline) {
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge edge = edge_of(outline, i);
    const double start3 = edge.start * edge.start * std::fabs(edge.start);
    const double end3 = edge.end * edge.end * std::fabs(edge.end);
    sum += 0.25 * (edge.end * end3 - edge.start * start3);
  }
  return 0.5 * sum;
}

void set_floe_drag(Bodies& bodies, std::size_t i, const SceneDef& scene) {
  bodies.drag[i] = 0.0;
  bodies.spin_drag[i] = 0.0;
  if (bodies.kind[i] != BodyKind::floe || scene.water.drag_law == DragLaw::none) return;
  if (scene.water.drag_law == DragLaw::quadratic) {
    set_quadratic(bodies, i, scene);
  } else {
    bodies.drag[i] = 1.0 / scene.water.linear_time_s;
    bodies.spin_drag[i] = scene.water.spin_drag ? bodies.drag[i] : 0.0;
  }
}

void set_drag(Bodies& bodies, const SceneDef& scene) {
  for (std::size_t i = 0; i < bodies.count(); ++i) set_floe_drag(bodies, i, scene);
}

}  // namespace gem
