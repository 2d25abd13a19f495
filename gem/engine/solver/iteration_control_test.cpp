// The extrapolation factors, restarts and the end of the iterations.
#include "gem/engine/solver/iteration_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace gem {
namespace {

TEST(MomentumCoefficients, IsNesterovsSequenceFromAFairStartAndFromNothing) {
  constexpr std::int64_t most = 40;
  const std::vector<float> momentum_coefficient = momentum_coefficients(most);
  ASSERT_EQ(momentum_coefficient.size(), 2u * most);
  EXPECT_EQ(momentum_coefficient[most], 0.0F) << "from nothing the first iteration carries nothing ahead";
  // theta' = (1 + sqrt(1 + 4 theta^2)) / 2, so theta'^2 - theta' = theta^2
  for (const auto& [first, theta] : {std::pair<std::int64_t, double>{0, 4.0}, {most, 1.0}}) {
    double now = theta;
    for (std::int64_t k = 0; k < most; ++k) {
      const double next = (now - 1.0) / static_cast<double>(momentum_coefficient[static_cast<std::size_t>(first + k)]);
      const bool divides = k > 0 || first == 0;  // division by zero at the restart
      EXPECT_TRUE(!divides || std::abs(next * next - next - now * now) < 1e-4 * now * now) << "iteration " << k;
      now = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * now * now));
    }
  }
}

TEST(IterationControl, BeginsFromNothingWhenTheResidualHasGrown) {
  constexpr std::int64_t most = 12;
  const std::vector<float> momentum_coefficient = momentum_coefficients(most);
  IterationControl control(1e-3, most, false, momentum_coefficient.data());
  EXPECT_EQ(control.momentum_coefficient(), momentum_coefficient[0]);
  EXPECT_EQ(control.after(1.0F), IterationControl::Next::iteration);
  EXPECT_EQ(control.momentum_coefficient(), momentum_coefficient[1]);
  EXPECT_EQ(control.after(2.5F), IterationControl::Next::iteration);
  EXPECT_EQ(control.momentum_coefficient(), momentum_coefficient[most]) << "more than twice the lowest";
}

TEST(IterationControl, EndsAtItsResidualWhereItLooksAndAtItsMost) {
  const std::vector<float> momentum_coefficient = momentum_coefficients(5);
  IterationControl met(0.5, 5, false, momentum_coefficient.data());
  met.momentum_coefficient();
  EXPECT_EQ(met.after(0.25F), IterationControl::Next::end);
  IterationControl slow(0.5, 5, false, momentum_coefficient.data());
  for (int k = 0; k < 5; ++k) {
    slow.momentum_coefficient();
    EXPECT_EQ(slow.after(1.0F), k < 4 ? IterationControl::Next::iteration : IterationControl::Next::end);
  }
  EXPECT_EQ(slow.iteration(), 5);
}

}  // namespace
}  // namespace gem
