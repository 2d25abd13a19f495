// Builds and runs the scenes of the compliant contacts.
#include "validation/contact/scenes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "gem/field/field.h"

namespace gem::hits {

SceneDef open_scene() {
  SceneDef scene;
  scene.run.name = "hits";
  scene.run.duration_s = 4000.0;
  scene.current.velocity_m_per_s = {0.0, 0.0};
  scene.water.drag_law = DragLaw::none;
  scene.ice.friction_ice = 0.0;
  scene.ice.friction_structure = 0.0;
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = false;
  scene.platform.present = false;
  scene.contact.solver = ContactSolver::compliant;
  scene.numerics.time_step_s = 0.1;
  scene.output.retire_x_m = 1e9;
  return scene;
}

std::vector<Vec2> rectangle(double length, double width) {
  const double x = 0.5 * length, y = 0.5 * width;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

std::vector<Vec2> rhombus(double side, double angle) {
  const double x = side * std::cos(0.5 * angle), y = side * std::sin(0.5 * angle);
  return {{-x, 0.0}, {0.0, -y}, {x, 0.0}, {0.0, y}};
}

std::vector<Vec2> regular(int sides, double radius) {
  std::vector<Vec2> outline;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * M_PI * k / sides;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

std::vector<Vec2> turned_by(std::vector<Vec2> outline, double angle) {
  for (Vec2& corner : outline) corner = rotate({std::cos(angle), std::sin(angle)}, corner);
  return outline;
}

FloeDef floe_of(std::vector<Vec2> outline, Vec2 position, Vec2 velocity, double spin) {
  return {std::move(outline), position, 0.0, velocity, spin, 1.0};
}

void add_wall(SceneDef& scene, double reach) {
  scene.platform.present = true;
  scene.platform.fixed = true;
  scene.platform.outline = PlatformOutline::listed;
  scene.platform.outline_m = {{0.0, -reach}, {20.0, -reach}, {20.0, reach}, {0.0, reach}};
  scene.platform.anchor_m = {10.0, 0.0};
}

FixedDef wall_body() { return {{{0.0, -200.0}, {20.0, -200.0}, {20.0, 200.0}, {0.0, 200.0}}}; }

void step_by(SceneDef& scene, double h, std::int64_t substeps) {
  scene.numerics.time_step_s = h * static_cast<double>(substeps);
  scene.numerics.substeps = substeps;
}

Trial::Trial(const SceneDef& scene, int threads) {
  EngineOptions options;
  options.threads = threads;
  engine = make_engine(scene, make_field(scene), options);
}

void Trial::advance(std::int64_t steps) { engine->advance(steps, log); }

void Trial::advance_for(const SceneDef& scene, double time) {
  advance(std::llround(time / scene.numerics.time_step_s));
}

Peak peak_of(const StepLog& log) {
  Peak peak;
  for (const ContactEvent& event : log.events) {
    peak.force = std::max(peak.force, event.largest_force);
    peak.depth = std::max(peak.depth, event.depth);
  }
  return peak;
}

std::vector<double> push_of(const StepLog& log, double dt) {
  std::vector<double> push;
  for (const PlatformStep& step : log.platform) push.push_back(step.ice_impulse.x / dt);
  return push;
}

double kinetic(const Bodies& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < b.count(); ++i)
    if (b.active[i] && b.kind[i] == BodyKind::floe)
      sum += 0.5 * b.mass[i] * dot(b.velocity[i], b.velocity[i]) + 0.5 * b.inertia[i] * b.spin[i] * b.spin[i];
  return sum;
}

double drag_of(const Bodies& bodies, std::size_t floe, double speed) {
  return bodies.mass[floe] * bodies.drag[floe] * speed * speed;
}

std::size_t first_floe(const Bodies& bodies) {
  return static_cast<std::size_t>(std::find(bodies.kind.begin(), bodies.kind.end(), BodyKind::floe) -
                                  bodies.kind.begin());
}

bool same_bits(const Bodies& a, std::size_t i, const Bodies& b, std::size_t j) {
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  return same(a.position[i].x, b.position[j].x) && same(a.position[i].y, b.position[j].y) &&
         same(a.velocity[i].x, b.velocity[j].x) && same(a.velocity[i].y, b.velocity[j].y) &&
         same(a.spin[i], b.spin[j]) && same(a.rotation[i].cosine, b.rotation[j].cosine) &&
         same(a.rotation[i].sine, b.rotation[j].sine);
}

}  // namespace gem::hits
