// Pareto fits to samples whose parameters are known.
#include "validation/paper/analysis/extremes/pareto.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

std::vector<double> pareto_sample(const Pareto& law, std::size_t count, std::uint64_t seed) {
  RandomSequence random = test_random(seed);
  std::vector<double> excesses(count);
  for (double& excess : excesses) excess = law.excess_at(random.uniform());
  return excesses;
}

TEST(Pareto, QuantilesInvertTheLaw) {
  for (const double shape : {-0.3, 0.0, 0.4})
    for (const double p : {0.9, 0.1, 1e-4})
      EXPECT_NEAR(Pareto({shape, 2.0}).probability_above(Pareto({shape, 2.0}).excess_at(p)), p, 1e-12);
  EXPECT_EQ(Pareto({-0.5, 2.0}).probability_above(4.1), 0.0);
  EXPECT_EQ(Pareto({-0.5, 2.0}).probability_above(-1.0), 1.0);
}

// Large samples: var(shape) = (1 + shape)^2 / n, var(scale) = 2 scale^2 (1 + shape) / n. Four deviations at n = 4000.
TEST(Pareto, FitFindsTheParameters) {
  for (const double shape : {-0.3, 0.0, 0.3}) {
    const Pareto fit = fit_pareto(pareto_sample({shape, 2.0}, 4000, 7));
    EXPECT_NEAR(fit.shape, shape, 4.0 * (1.0 + shape) / std::sqrt(4000.0));
    EXPECT_NEAR(fit.scale, 2.0, 4.0 * 2.0 * std::sqrt(2.0 * (1.0 + shape) / 4000.0));
  }
}

// At the maximum of the likelihood its slope is zero in both parameters, so neighbours are less likely.
TEST(Pareto, FitIsTheMostLikely) {
  const std::vector<double> excesses = pareto_sample({0.2, 1.5}, 200, 3);
  const auto log_likelihood = [&](double shape, double scale) {
    double sum = 0.0;
    for (const double y : excesses) sum -= std::log(scale) + (1.0 + 1.0 / shape) * std::log1p(shape * y / scale);
    return sum;
  };
  const Pareto fit = fit_pareto(excesses);
  const double best = log_likelihood(fit.shape, fit.scale);
  for (const double step : {-1e-3, 1e-3}) {
    EXPECT_GT(best, log_likelihood(fit.shape + step, fit.scale));
    EXPECT_GT(best, log_likelihood(fit.shape, fit.scale + step));
  }
}

// Uniform values have shape -1, where the likelihood has no maximum: the fit stays at the edge of its range.
TEST(Pareto, FitOfABoundedSampleEndsAboveItsLargest) {
  const std::vector<double> excesses = pareto_sample({-1.0, 2.0}, 100, 5);
  const Pareto fit = fit_pareto(excesses);
  EXPECT_LT(fit.shape, -0.7);
  EXPECT_GE(fit.shape, -1.0);
  EXPECT_NEAR(-fit.scale / fit.shape, 2.0, 0.1);
}

TEST(Pareto, RefusesFewOrNegativeExcesses) {
  EXPECT_THROW(fit_pareto(std::vector<double>(9, 1.0)), std::invalid_argument);
  std::vector<double> excesses(20, 1.0);
  excesses[3] = -0.1;
  EXPECT_THROW(fit_pareto(excesses), std::invalid_argument);
}

}  // namespace
}  // namespace gem
