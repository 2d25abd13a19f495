// A floe hits the moored platform and stays pressed against it: V10.
#include <algorithm>
#include <cmath>

#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class MooredImpact : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, MooredImpact, ::testing::ValuesIn(all_settings()), setting_name);

TEST_P(MooredImpact, V10_floe_on_the_moored_platform) {
  const double dt = 0.01, platform_mass = 1e8;
  SceneDef scene = quiet_scene();
  scene.numerics.time_step_s = dt;
  scene.platform.present = true;
  scene.floe = {square({-55.0 + touch, 0.0}, {0.25, 0.0})};
  Simulation run = start(scene, setting());
  run.advance(1);
  ASSERT_EQ(run.log.events.size(), 1u);
  const double impulse = run.log.platform[0].ice_impulse.x;
  check("V10.J", impulse, rounding, where());
  check("V10.v", impulse / platform_mass, rounding, where());
  // A difference of speeds of 0.25 m/s.
  check_absolute("V10.v", run.bodies().velocity[1].x, 0.25 * 1e-15, where());
  check("V10.dE", -run.engine->ledger()[Channel::impact].energy, rounding, where());

  double pressed_until = 0.0, peak = 0.0, lowest = 0.0;
  while (run.engine->step() < 8000) {
    run.advance(1);
    const double time = static_cast<double>(run.engine->step()) * dt;
    if (run.log.platform.back().ice_impulse.x > 0.0) pressed_until = time;
    peak = std::max(peak, run.bodies().position[0].x);
    lowest = std::min(lowest, run.bodies().position[0].x);
  }
  // The floe lags the platform's half time steps by one dt: omega dt m / M = 3e-7 of the amplitude. Sampling: (omega
  // dt)^2 / 8.
  const double lag = 4e-7;
  check("V10.xpeak", peak, lag, where());
  check("V10.xpeak_up", -lowest, lag, where());
  check("V10.E_osc", 0.5 * scene.mooring.stiffness_N_per_m * lowest * lowest, 2.0 * lag, where());
  check_absolute("V10.t_sep", pressed_until, 2.0 * dt, where());
  expect_closed_books(run, 1e-11);
}

}  // namespace
}  // namespace gem::verification
