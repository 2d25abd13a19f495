// The size laws: their parameters reproduce the requested moments, and their quantiles agree with quadrature.
#include "gem/field/generator/size_law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/base/error.h"

namespace gem {
namespace {

struct SampleMoments {
  double mean = 0.0;
  double deviation = 0.0;
};

SampleMoments sample(const TruncatedSizeLaw& law, int n) {
  double sum = 0.0, square = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = law.quantile((i + 0.5) / n);
    sum += x;
    square += x * x;
  }
  return {sum / n, std::sqrt(square / n - sum / n * sum / n)};
}

TEST(SizeLaw, LognormalParametersOfThePaper) {
  const TruncatedSizeLaw law(FloesDef{});
  EXPECT_NEAR(law.location(), 1.744193, 5e-7);
  EXPECT_NEAR(law.scale(), 0.693043, 5e-7);
  const double probability[] = {0.05, 0.25, 0.5, 0.75, 0.95};
  const double size[] = {2.44, 3.90, 5.87, 8.93, 15.12};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(law.quantile(probability[i]), size[i], 0.006);
}

TEST(SizeLaw, GammaParametersOfThePaper) {
  FloesDef floes;
  floes.size_law = SizeLaw::gamma;
  const TruncatedSizeLaw law(floes);
  EXPECT_NEAR(law.location(), 1.757837, 5e-7);
  EXPECT_NEAR(law.scale(), 3.582115, 5e-7);
  EXPECT_NEAR(law.quantile(0.5), 5.93, 0.006);
}

TEST(SizeLaw, QuantilesHaveTheAskedMoments) {
  for (const SizeLaw kind : {SizeLaw::lognormal, SizeLaw::gamma}) {
    FloesDef floes;
    floes.size_law = kind;
    const SampleMoments m = sample(TruncatedSizeLaw(floes), 100000);
    // Midpoints have an error O(1/n^2), the panels about 1e-6 of the size.
    EXPECT_NEAR(m.mean, 6.9, 1e-5);
    EXPECT_NEAR(m.deviation, 3.9, 1e-5);
  }
}

TEST(SizeLaw, QuantilesStayInsideAndGrow) {
  const TruncatedSizeLaw law(FloesDef{});
  double last = 2.0;
  for (int i = 1; i < 2000; ++i) {
    const double x = law.quantile(i / 2000.0);
    EXPECT_GT(x, last);
    last = x;
  }
  EXPECT_LT(last, 20.0);
  EXPECT_GE(law.quantile(1e-15), 2.0);
  EXPECT_LE(law.quantile(1.0 - 1e-15), 20.0);
}

TEST(SizeLaw, ZeroDeviationGivesEqualFloes) {
  FloesDef floes;
  floes.size_deviation_m = 0.0;
  EXPECT_EQ(TruncatedSizeLaw(floes).quantile(0.9), 6.9);
}

TEST(SizeLaw, ImpossibleMomentsAreRefused) {
  FloesDef wide;
  wide.size_deviation_m = 9.5;
  EXPECT_THROW(TruncatedSizeLaw{wide}, Error);
  FloesDef outside;
  outside.size_mean_m = 25.0;
  EXPECT_THROW(TruncatedSizeLaw{outside}, Error);
}

}  // namespace
}  // namespace gem
