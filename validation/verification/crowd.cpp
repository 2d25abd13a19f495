// Builds and compares crowds of floes.
#include "validation/verification/crowd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "gem/base/random.h"
#include "gem/base/strict_math.h"
#include "gem/field/field.h"

namespace gem::verification {

SceneDef crowd(const Setting& setting, Surroundings surroundings) {
  SceneDef scene = quiet_scene();
  scene.numerics.time_step_s = 0.05;
  scene.numerics.residual_tolerance = 1e-6;
  scene.numerics.iterations_maximum = 50;
  scene.current.velocity_m_per_s = {0.5, 0.125};
  scene.water.drag_law = DragLaw::quadratic;
  scene.ice.friction_ice = 0.35;
  scene.ice.friction_structure = 0.1;
  setting.apply_to(scene);
  scene.contact.manifold = setting.coupled() ? Manifold::chord_ends : Manifold::chord_middle;
  scene.contact.elastic_stiffness_N_per_m = 1e6;
  if (surroundings == Surroundings::walls_and_platform) {
    scene.platform.present = true;
    scene.platform.diameter_m = 24.0;
    scene.platform.mass_kg = 1e6;
    scene.mooring.stiffness_N_per_m = 5e4;
    scene.fixed = {{{{-96.0, 28.0}, {32.0, 26.0}, {32.0, 40.0}, {-96.0, 40.0}}},
                   {{{-96.0, -40.0}, {32.0, -40.0}, {32.0, -26.0}, {-96.0, -28.0}}}};
  }
  RandomSequence numbers(Random(7, 1));
  for (int column = 0; column < 7; ++column)
    for (int row = 0; row < 5; ++row) {
      const int sides = 4 + static_cast<int>(numbers.below(4));
      FloeDef floe;
      for (int i = 0; i < sides; ++i)
        floe.outline_m.push_back(rotate(strict::rotation_of_turns(static_cast<double>(i) / sides), {4.75, 0.0}));
      floe.position_m = {-18.0 - 10.0 * column, -20.0 + 10.0 * row};
      floe.angle_rad = numbers.uniform(0.0, 6.0);
      floe.velocity_m_per_s = {0.25 * numbers.uniform(-1.0, 1.0), 0.25 * numbers.uniform(-1.0, 1.0)};
      floe.spin_rad_per_s = 0.02 * numbers.uniform(-1.0, 1.0);
      scene.floe.push_back(floe);
    }
  return scene;
}

SceneDef settled(SceneDef scene) {
  scene.numerics.residual_tolerance = 1e-14;
  scene.numerics.iterations_maximum = 20000;
  scene.numerics.repair_share = 0.0;
  return scene;
}

Bodies pressed(const SceneDef& scene, const Setting& setting) {
  Simulation run = start(scene, {"cpu", setting.solver, setting.iteration});
  run.advance(1600);
  return run.bodies();
}

Simulation start_on(const SceneDef& scene, Bodies bodies, const Setting& setting) {
  return {make_engine(scene, std::move(bodies), {setting.engine, 1}), {}, {}};
}

std::int64_t advance_in_contact(Simulation& run, std::int64_t steps) {
  const std::size_t before = run.log.quality.size();
  run.advance(steps);
  std::int64_t points = 0;
  for (std::size_t i = before; i < run.log.quality.size(); ++i) points += run.log.quality[i].contacts;
  EXPECT_GT(points, 0) << "the bodies never touched";
  return points;
}

int different_bits(const Bodies& a, const Bodies& b, std::size_t count) {
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  const std::size_t n = count > 0 ? count : a.count();
  int different = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (!(same(a.position[i].x, b.position[i].x) && same(a.position[i].y, b.position[i].y) &&
          same(a.velocity[i].x, b.velocity[i].x) && same(a.velocity[i].y, b.velocity[i].y) &&
          same(a.rotation[i].cosine, b.rotation[i].cosine) && same(a.rotation[i].sine, b.rotation[i].sine) &&
          same(a.spin[i], b.spin[i])))
      ++different;
  return different;
}

double farthest_apart(const Bodies& a, const Bodies& b) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < a.count(); ++i) {
    const Vec2 turned{a.rotation[i].cosine - b.rotation[i].cosine, a.rotation[i].sine - b.rotation[i].sine};
    farthest = std::max(farthest, length(a.position[i] - b.position[i]) + a.radius[i] * length(turned));
  }
  return farthest;
}

void expect_restart_changes_nothing(const SceneDef& scene, const Setting& setting) {
  Simulation whole = start(scene, setting), part = start(scene, setting), rest = start(scene, setting);
  whole.advance(40);
  part.advance(15);
  rest.engine->restore(part.engine->save());
  rest.advance(25);
  EXPECT_EQ(rest.engine->state_hash(), whole.engine->state_hash());
}

}  // namespace gem::verification
