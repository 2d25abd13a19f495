// Period and damping of known decays, with and without noise.
#include "validation/paper/analysis/fits/free_decay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

std::vector<double> decay(double natural_period, double ratio, double rest, std::size_t count, double interval) {
  const double omega = kTestTurn / natural_period;
  std::vector<double> signal(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double time = interval * static_cast<double>(i);
    signal[i] = rest + std::exp(-ratio * omega * time) * std::cos(omega * std::sqrt(1.0 - ratio * ratio) * time);
  }
  return signal;
}

// A straight line between samples shifts a crossing by zeta omega dt^2 / 4 = 2e-6 s. The trapezoidal rule changes all
// areas by the same share, (omega dt)^2 / 12, except for the position of the crossing on the grid.
TEST(FreeDecay, OfAMooredPlatform) {
  const auto fit = free_decay(decay(88.8577, 0.01, 0.2, 12000, 0.1), 0.1, 0.2);
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(fit->half_cycles, 26u);
  EXPECT_NEAR(fit->natural_period.value, 88.8577, 88.8577e-6);
  EXPECT_NEAR(fit->period.value, 88.8577 / std::sqrt(1.0 - 1e-4), 88.8577e-6);
  EXPECT_NEAR(fit->damping_ratio.value, 0.01, 1e-7);
  EXPECT_LT(fit->period.high - fit->period.low, 1e-5);
}

TEST(FreeDecay, WithoutDampingIsZero) {
  const auto fit = free_decay(decay(88.8577, 0.0, 0.0, 40000, 0.1), 0.1);
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->damping_ratio.value, 0.0, 1e-9);
  EXPECT_NEAR(fit->natural_period.value, 88.8577, 88.8577e-6);
}

TEST(FreeDecay, StopsAtTheFloor) {
  const std::vector<double> noisy = sum_of(decay(50.0, 0.05, 0.0, 8000, 0.1), white_noise(8000, 1e-3, 8));
  const auto fit = free_decay(noisy, 0.1, 0.0, 0.05);
  ASSERT_TRUE(fit.has_value());
  // e^(-0.157 n) falls below 0.05 after 19 half cycles; the first has no crossing before it.
  EXPECT_NEAR(static_cast<double>(fit->half_cycles), 18.0, 1.0);
  EXPECT_TRUE(fit->damping_ratio.holds(0.05));
  EXPECT_LT(fit->damping_ratio.high - fit->damping_ratio.low, 0.01);
}

TEST(FreeDecay, IsEmptyWithoutASwing) {
  EXPECT_FALSE(free_decay(std::vector<double>(1000, 1.0), 0.1).has_value());
  EXPECT_FALSE(free_decay(decay(50.0, 0.05, 0.0, 800, 0.1), 0.1).has_value());
}

}  // namespace
}  // namespace gem
