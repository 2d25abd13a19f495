// The null model against Campbell's theorem for a linear system under Poisson impulses.
#include "validation/paper/analysis/chaos/impulse_oscillator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "gem/analysis/statistics/moments.h"
#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

TEST(ImpulseOscillator, SamplesOneMotionAtAnyInterval) {
  const ImpulseOscillator model;
  const auto coarse = impulse_oscillator(model, 100, 10.0, 5);
  const auto fine = impulse_oscillator(model, 1000, 1.0, 5);
  for (std::size_t i = 0; i < 100; ++i) {
    // Rounding of about 100 exact steps of size 1e-3.
    EXPECT_NEAR(coarse.position[i], fine.position[10 * i], 1e-13);
    EXPECT_NEAR(coarse.velocity[i], fine.velocity[10 * i], 1e-14);
  }
  EXPECT_NE(fine.position[500], impulse_oscillator(model, 1000, 1.0, 6).position[500]);
}

// Stationary state: var x = rate E[v^2] / (4 zeta omega^3), mean x = rate E[v] / omega^2. 2e5 s are 200 times the
// memory 1 / (zeta omega). So the deviation scatters by 1 / (2 sqrt(100)) = 5 %, the mean by sqrt(rate E[v^2] / T) /
// omega^2.
TEST(ImpulseOscillator, HasCampbellsMoments) {
  ImpulseOscillator model;
  model.natural_period = 100.0;
  model.damping_ratio = 0.016;
  model.speed_mean = 1e-3;
  const double omega = kTestTurn / 100.0;
  const auto record = impulse_oscillator(model, 200000, 1.0, 1);
  const Moments about = moments(std::span(record.position).subspan(5000));
  const double power = model.impulse_rate * 2e-6;
  const double deviation = std::sqrt(power / (4.0 * model.damping_ratio * omega * omega * omega));
  EXPECT_NEAR(about.deviation, deviation, 0.15 * deviation);
  EXPECT_NEAR(about.mean, model.impulse_rate * 1e-3 / (omega * omega), 3.0 * std::sqrt(power / 2e5) / (omega * omega));
}

TEST(ImpulseOscillator, RefusesWhatIsNoOscillator) {
  ImpulseOscillator model;
  model.damping_ratio = 1.0;
  EXPECT_THROW(impulse_oscillator(model, 10, 1.0, 1), std::invalid_argument);
  EXPECT_THROW(impulse_oscillator({}, 10, 0.0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace gem
