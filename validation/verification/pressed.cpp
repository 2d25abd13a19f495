// Scenes pressed by the current, and their checks.
#include "validation/verification/pressed.h"

#include <algorithm>

#include "gem/base/strict_math.h"

namespace gem::verification {

double skin_for(double k) { return k * 900.0 * 0.5 / 1025.0; }

SceneDef pressed_scene(Vec2 current, double skin_coefficient, double friction, double dt) {
  SceneDef scene = quiet_scene();
  scene.current.velocity_m_per_s = current;
  scene.water.drag_law = DragLaw::quadratic;
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = skin_coefficient;
  scene.ice.friction_ice = friction;
  scene.numerics.time_step_s = dt;
  return scene;
}

FixedDef long_floor(double angle) {
  FixedDef floor{{{-2000.0, -16.0}, {2000.0, -16.0}, {2000.0, 0.0}, {-2000.0, 0.0}}};
  for (Vec2& p : floor.outline_m) p = rotate(strict::rotation_of_angle(angle), p);
  return floor;
}

Vec2 force_of_fixed(Simulation& run, std::int64_t steps, double dt) {
  const Ledger before = run.engine->ledger();
  run.advance(steps);
  const Ledger after = run.engine->ledger();
  Vec2 given;
  for (const Channel c : {Channel::impact, Channel::friction, Channel::elastic})
    given += after[c].momentum - before[c].momentum;
  return (1.0 / (static_cast<double>(steps) * dt)) * given;
}

double drag_shortfall(double k, double slip, double dt) { return 1.01 * k * slip * dt; }

void expect_held_books(Simulation& run, double reach) {
  const Ledger now = run.engine->ledger();
  const LedgerResidual left = residual(now);
  const double momentum = std::max(now.momentum_scale, 45000.0 * length({0.5, 0.0}));
  EXPECT_LE(left.momentum * now.momentum_scale, 1e-11 * momentum);
  EXPECT_LE(left.angular_momentum * now.angular_scale, 1e-11 * momentum * reach);
  EXPECT_LE(left.energy, 1e-10);
}

}  // namespace gem::verification
