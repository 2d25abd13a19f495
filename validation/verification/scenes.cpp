// Builds the scenes of the closed-form cases.
#include "validation/verification/scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "gem/base/strict_math.h"
#include "gem/field/field.h"
#include "validation/verification/baselines.h"

namespace gem::verification {
namespace {

double kinetic(const Bodies& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < b.count(); ++i)
    sum += 0.5 * b.mass[i] * dot(b.velocity[i], b.velocity[i]) + 0.5 * b.inertia[i] * b.spin[i] * b.spin[i];
  return sum;
}

/// The engines of every build, and the engine named by GEM_MORE_ENGINES.
std::vector<std::string> engines() {
  std::vector<std::string> names = engine_names();
  const char* more = std::getenv("GEM_MORE_ENGINES");
  if (more && std::find(names.begin(), names.end(), more) == names.end()) names.push_back(more);
  return names;
}

}  // namespace

std::vector<Setting> all_settings() {
  std::vector<Setting> settings = surveyed_baselines();
  if (!settings.empty()) return settings;
  for (const std::string& engine : engines())
    for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled})
      settings.push_back({engine, solver});
  settings.push_back({"cpu", ContactSolver::coupled, Iteration::gradient});
  return settings;
}

std::vector<Setting> coupled_settings() {
  std::vector<Setting> settings;
  for (const std::string& engine : engines()) settings.push_back({engine, ContactSolver::coupled});
  settings.push_back({"cpu", ContactSolver::coupled, Iteration::gradient});
  return settings;
}

std::string setting_name(const ::testing::TestParamInfo<Setting>& info) {
  return info.param.engine + "_" + info.param.where().solver;
}

void PrintTo(const Setting& setting, std::ostream* out) { *out << setting.engine << ' ' << setting.where().solver; }

SceneDef quiet_scene() {
  SceneDef scene;
  scene.run.name = "verification";
  scene.current.velocity_m_per_s = {0.0, 0.0};
  scene.water.drag_law = DragLaw::none;
  scene.ice.friction_ice = 0.0;
  scene.ice.friction_structure = 0.0;
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = false;
  scene.platform.present = false;
  scene.contact.elastic_stiffness_N_per_m = 0.0;
  scene.contact.crushing_limit = false;
  scene.numerics.time_step_s = 1e-6;
  scene.run.duration_s = 600.0;  // few enough time steps for cuda
  scene.numerics.residual_tolerance = 1e-14;
  scene.numerics.iterations_maximum = 20000;
  scene.numerics.repair_share = 0.0;
  scene.output.retire_x_m = 1e9;
  return scene;
}

std::vector<Vec2> rectangle(double length, double width) {
  const double x = 0.5 * length, y = 0.5 * width;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

FloeDef square(Vec2 position, Vec2 velocity, double angle, double spin) {
  return {rectangle(10.0, 10.0), position, angle, velocity, spin, 0.5};
}

FloeDef rod(Vec2 position, Vec2 velocity, double angle, double spin) {
  return {rectangle(20.0, 1.0), position, angle, velocity, spin, 0.5};
}

double degrees(double angle) { return angle * (std::numbers::pi / 180.0); }

FixedDef floor_wall() { return {{{-64.0, -16.0}, {64.0, -16.0}, {64.0, 0.0}, {-64.0, 0.0}}}; }

Vec2 lowest_corner(const FloeDef& floe) {
  const Rotation turn = strict::rotation_of_angle(floe.angle_rad);
  Vec2 lowest = rotate(turn, floe.outline_m[0]);
  for (const Vec2 corner : floe.outline_m)
    if (rotate(turn, corner).y < lowest.y) lowest = rotate(turn, corner);
  return lowest;
}

FloeDef on_floor(FloeDef floe) {
  floe.position_m.y = -lowest_corner(floe).y - touch;
  return floe;
}

SceneDef over_floor(const FloeDef& floe, double friction) {
  SceneDef scene = quiet_scene();
  scene.ice.friction_ice = friction;
  scene.fixed = {floor_wall()};
  scene.floe = {on_floor(floe)};
  return scene;
}

SceneDef corner_on_face(double friction) {
  FloeDef b{rectangle(8.0, 4.0), {}, degrees(20.0), {-0.6, 0.35}, 0.03, 0.5};
  const double c = std::cos(b.angle_rad), s = std::sin(b.angle_rad);
  b.position_m = Vec2{5.0 - touch, 2.0} - Vec2{-4.0 * c - 2.0 * s, -4.0 * s + 2.0 * c};
  SceneDef scene = quiet_scene();
  scene.ice.friction_ice = friction;
  scene.floe = {square({}, {0.1, 0.0}, 0.0, -0.01), b};
  return scene;
}

SceneDef row_of_squares(int count, double speed) {
  SceneDef scene = quiet_scene();
  for (int i = 0; i < count; ++i) scene.floe.push_back(square({(10.0 - touch) * i, 0.0}));
  scene.floe[0].velocity_m_per_s = {speed, 0.0};
  return scene;
}

Simulation start(SceneDef scene, const Setting& setting) {
  setting.apply_to(scene);
  Simulation run{make_engine(scene, make_field(scene), {setting.engine, 1}), {}, {}};
  run.first = run.engine->ledger();
  return run;
}

double angular_momentum(const Bodies& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < b.count(); ++i)
    sum += b.mass[i] * cross(b.position[i], b.velocity[i]) + b.inertia[i] * b.spin[i];
  return sum;
}

void expect_closed_books(Simulation& run, double tolerance, double momentum_seen) {
  const Ledger now = run.engine->ledger();
  const LedgerResidual left = residual(now);
  // The scale of the ledger is the largest momentum at the times when it was read.
  const double momentum_share = now.momentum_scale / std::max(now.momentum_scale, momentum_seen);
  EXPECT_LE(momentum_seen > 0.0 ? left.momentum * momentum_share : left.momentum, tolerance);
  EXPECT_LE(left.angular_momentum, tolerance);
  EXPECT_LE(left.energy, tolerance);
}

Vec2 Impact::impulse(std::size_t floe) const {
  const std::size_t i = first_floe + floe;
  return after.mass[i] * (after.velocity[i] - before.velocity[i]);
}

double Impact::energy_lost() const { return kinetic(before) - kinetic(after); }

Impact one_impact(const SceneDef& scene, const Setting& setting) {
  Simulation run = start(scene, setting);
  Impact impact;
  impact.before = run.bodies();
  impact.first_floe = static_cast<std::size_t>(platform_bodies(impact.before)) + scene.fixed.size();
  run.advance(1);
  impact.after = run.bodies();
  impact.ledger = run.engine->ledger();
  impact.state = run.engine->save();
  impact.quality = run.log.quality.at(0);
  EXPECT_GT(impact.quality.contacts, 0) << "the bodies never touched";
  expect_closed_books(run);
  return impact;
}

FixedDef notch_side(double angle, double side) {
  const Vec2 along{side * std::sin(angle), std::cos(angle)}, out{side * std::cos(angle), -std::sin(angle)};
  std::vector<Vec2> corners = {1.0 * along, 1.0 * along + 8.0 * out, 40.0 * along + 8.0 * out, 40.0 * along};
  if (side < 0.0) corners = {corners[3], corners[2], corners[1], corners[0]};
  return {corners};
}

}  // namespace gem::verification
