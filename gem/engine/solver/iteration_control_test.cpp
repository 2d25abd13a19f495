// The extrapolation factors, restarts and the end of the iterations.
#include "gem/engine/solver/iteration_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace gem {
namespace {

TEST(MomentumCoefficients, FollowNesterovsSequenceFromBothStarts) {
  constexpr std::int64_t most = 40;
  const std::vector<float> coefficients = momentum_coefficients(most);
  ASSERT_EQ(coefficients.size(), 2u * most);
  EXPECT_EQ(coefficients[most], 0.0F) << "the first iteration after a restart does not extrapolate";
  // theta' = (1 + sqrt(1 + 4 theta^2)) / 2, so theta'^2 - theta' = theta^2
  for (const auto& [first, theta] : {std::pair<std::int64_t, double>{0, 4.0}, {most, 1.0}}) {
    double now = theta;
    for (std::int64_t k = 0; k < most; ++k) {
      const double next = (now - 1.0) / static_cast<double>(coefficients[static_cast<std::size_t>(first + k)]);
      const bool divides = k > 0 || first == 0;  // the first coefficient after a restart is 0
      EXPECT_TRUE(!divides || std::abs(next * next - next - now * now) < 1e-4 * now * now) << "iteration " << k;
      now = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * now * now));
    }
  }
}

TEST(IterationControl, RestartsWhenTheResidualHasGrown) {
  constexpr std::int64_t most = 12;
  const std::vector<float> coefficients = momentum_coefficients(most);
  IterationControl control(1e-3, most, false, coefficients.data());
  EXPECT_EQ(control.momentum_coefficient(), coefficients[0]);
  EXPECT_EQ(control.after(1.0F), IterationControl::Next::iteration);
  EXPECT_EQ(control.momentum_coefficient(), coefficients[1]);
  EXPECT_EQ(control.after(2.5F), IterationControl::Next::iteration);
  EXPECT_EQ(control.momentum_coefficient(), coefficients[most]) << "more than twice the lowest";
}

TEST(IterationControl, EndsAtTheResidualAndAtTheIterationLimit) {
  const std::vector<float> coefficients = momentum_coefficients(5);
  IterationControl met(0.5, 5, false, coefficients.data());
  met.momentum_coefficient();
  EXPECT_EQ(met.after(0.25F), IterationControl::Next::end);
  IterationControl slow(0.5, 5, false, coefficients.data());
  for (int k = 0; k < 5; ++k) {
    slow.momentum_coefficient();
    EXPECT_EQ(slow.after(1.0F), k < 4 ? IterationControl::Next::iteration : IterationControl::Next::end);
  }
  EXPECT_EQ(slow.iteration(), 5);
}

}  // namespace
}  // namespace gem
