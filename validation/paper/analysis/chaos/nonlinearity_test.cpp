// Asymmetry and predictability of known records.
#include "validation/paper/analysis/chaos/nonlinearity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

TEST(TimeReversalAsymmetry, OfASawTooth) {
  std::vector<double> saw(200);
  for (std::size_t i = 0; i < saw.size(); ++i) saw[i] = static_cast<double>(i % 10);
  const double forward = time_reversal_asymmetry(saw, 1);
  std::reverse(saw.begin(), saw.end());
  EXPECT_DOUBLE_EQ(time_reversal_asymmetry(saw, 1), -forward);
  EXPECT_LT(forward, -1.0);
  EXPECT_EQ(time_reversal_asymmetry(std::vector<double>(50, 1.0), 3), 0.0);
  EXPECT_THROW(time_reversal_asymmetry(saw, 0), std::invalid_argument);
}

TEST(PredictionError, OfAMapAndOfNoise) {
  EXPECT_LT(prediction_error(logistic_map(500, 4.0), {{1, 1, 1}, 1, 4}), 0.1);
  // The mean of ten independent neighbours gives sqrt(1 + 1/10).
  EXPECT_NEAR(prediction_error(white_noise(800, 1.0, 2), {{3, 1, 1}, 1, 10}), 1.05, 0.08);
  EXPECT_THROW(prediction_error(std::vector<double>(100, 1.0)), std::invalid_argument);
  EXPECT_THROW(prediction_error(white_noise(8, 1.0, 1), {{3, 4, 1}, 1, 10}), std::invalid_argument);
}

}  // namespace
}  // namespace gem
