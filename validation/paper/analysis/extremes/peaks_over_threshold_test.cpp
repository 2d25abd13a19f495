// Return values of processes whose extremes are known.
#include "validation/paper/analysis/extremes/peaks_over_threshold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

/// Runs with independent peaks every 100 s: `offset` plus a Pareto excess.
std::vector<RunPeaks> pareto_runs(const Pareto& law, std::size_t runs, std::uint64_t seed) {
  RandomSequence random = test_random(seed);
  std::vector<RunPeaks> result(runs);
  for (RunPeaks& run : result) {
    run.duration = 7200.0;
    for (int i = 0; i < 72; ++i) run.peaks.push_back(1.0 + law.excess_at(random.uniform()));
  }
  return result;
}

TEST(ThresholdModel, HasTheRateAndTheQuantileOfItsLaw) {
  const Pareto law{-0.2, 0.5};
  const auto model = fit_threshold_model(pareto_runs(law, 60, 5), 1.0);
  ASSERT_TRUE(model.has_value());
  EXPECT_DOUBLE_EQ(model->rate, 0.01);
  // 108 peaks in 3 h: P(all below x) = exp(-108 P(above)). At 4320 peaks the likelihood estimate has a deviation of 1
  // %.
  const double truth = 1.0 + law.excess_at(-std::log(0.9) / 108.0);
  EXPECT_NEAR(model->quantile(0.9, 10800.0), truth, 0.05 * truth);
  EXPECT_EQ(model->quantile(0.1, 1.0), 1.0);
  EXPECT_FALSE(fit_threshold_model(pareto_runs(law, 1, 5), 3.0).has_value());
}

// Excesses of a Pareto law over a higher threshold have the same shape and modified scale. For large samples var(shape)
// = (1 + shape)^2 / n, var(scale) = 2 scale^2 (1 + shape) / n. Allowed: four deviations; widths from 20 resamples to 50
// %.
TEST(ThresholdStability, IsLevelForAParetoLaw) {
  const auto runs = pareto_runs({-0.2, 0.5}, 10, 6);
  const auto rows = threshold_stability(runs, std::vector<double>{1.0, 1.2, 1.4, 9.0}, {}, {20, 0.95, 1});
  ASSERT_EQ(rows.size(), 3u);
  for (const ThresholdStability& row : rows) {
    const double root = std::sqrt(static_cast<double>(row.peaks));
    EXPECT_NEAR(row.shape.value, -0.2, 4.0 * 0.8 / root) << row.threshold;
    // Modified scale about the threshold 1 of the law: 0.5 + 0.2. Its scatter adds that of shape times threshold.
    EXPECT_NEAR(row.modified_scale.value, 0.7, 4.0 * (0.5 * std::sqrt(1.6) + 0.8 * row.threshold) / root);
    EXPECT_NEAR(row.shape.high - row.shape.low, 2.0 * 2.2 * 0.8 / root, 2.2 * 0.8 / root) << row.threshold;
  }
  EXPECT_GT(rows[0].peaks, rows[1].peaks);
}

// 100 intervals of 95 % from 15 runs: one standard deviation is 2.2 %. The bias of the shape from 1080 peaks is small.
// The limit of 87 is three and a half deviations.
TEST(LongThresholdModel, IntervalOverRunsCovers) {
  const Pareto law{-0.1, 0.5};
  const double truth = 1.0 + law.excess_at(-std::log(0.9) / 108.0);
  int shape = 0;
  int quantile = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto rows =
        threshold_stability(pareto_runs(law, 15, 1000 + seed), std::vector<double>{1.0}, {}, {100, 0.95, seed});
    ASSERT_EQ(rows.size(), 1u);
    shape += rows[0].shape.holds(-0.1) ? 1 : 0;
    quantile += rows[0].quantile.holds(truth) ? 1 : 0;
  }
  EXPECT_GE(shape, 87);
  EXPECT_GE(quantile, 87);
}

}  // namespace
}  // namespace gem
