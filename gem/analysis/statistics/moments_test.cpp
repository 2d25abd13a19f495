// Moments, extremes and the interval of the mean on records computed by hand or with known correlation.
#include "gem/analysis/statistics/moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gem {
namespace {

TEST(Moments, OfAShortRecord) {
  const std::vector<double> signal = {1.0, 2.0, 3.0, 6.0};
  const Moments result = moments(signal);
  EXPECT_DOUBLE_EQ(result.mean, 3.0);
  EXPECT_DOUBLE_EQ(result.deviation, std::sqrt(14.0 / 4.0));
  EXPECT_DOUBLE_EQ(result.minimum, 1.0);
  EXPECT_DOUBLE_EQ(result.maximum, 6.0);
}

TEST(Excursions, AreSignedOnAnAxisAndRadialInThePlane) {
  const std::vector<double> x = {0.0, 3.0, -4.0, 1.0};
  const std::vector<double> y = {0.0, 4.5, 1.0, 1.0};
  EXPECT_DOUBLE_EQ(maximum_excursion(x).value, -4.0);
  EXPECT_EQ(maximum_excursion(x).sample, 2u);
  EXPECT_DOUBLE_EQ(maximum_excursion(x, -2.0).value, 5.0);
  const Excursion radial = maximum_radial_excursion(x, y, 0.0, 0.5);
  EXPECT_DOUBLE_EQ(radial.value, 5.0);
  EXPECT_EQ(radial.sample, 1u);
}

TEST(Percentile, InterpolatesTheSortedRecord) {
  const std::vector<double> signal = {4.0, 1.0, 3.0, 2.0, 5.0};
  EXPECT_DOUBLE_EQ(percentile(signal, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(percentile(signal, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(percentile(signal, 0.9), 4.6);
}

TEST(Intermittency, IsTheFractionOfSamplesInContact) {
  EXPECT_DOUBLE_EQ(intermittency(std::vector<double>{0.0, 2.0, 1.0, 0.0, 0.0}), 0.4);
  EXPECT_DOUBLE_EQ(intermittency({}), 0.0);
}

}  // namespace
}  // namespace gem
