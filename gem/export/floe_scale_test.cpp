// Parting of overlapping floes, against overlaps known by hand.
#include "gem/export/floe_scale.h"

#include <gtest/gtest.h>

#include "gem/base/error.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

std::vector<Vec2> square(double half) { return {{-half, -half}, {half, -half}, {half, half}, {-half, half}}; }

FrameFloe floe_at(std::size_t index, Vec2 position, double half) { return {index, position, square(half), {}, 0.0}; }

std::vector<Vec2> drawn(const FrameFloe& floe, double scale) {
  std::vector<Vec2> corners;
  for (const Vec2 corner : floe.outline) corners.push_back(floe.position + scale * corner);
  return corners;
}

TEST(FloeScale, TwoSquaresShareTheirOverlap) {
  // Half sides 1 and 3, centres 3.8 apart: they overlap by 0.2, which is 5 % of their reach of 4.
  const std::vector<FrameFloe> floes = {floe_at(0, {0, 0}, 1), floe_at(1, {3.8, 0.5}, 3), floe_at(2, {0, -4.1}, 1)};
  const std::vector<double> scales = parting_scales(floes, {});
  EXPECT_NEAR(scales[0], 0.95, 1e-6);
  EXPECT_EQ(scales[0], scales[1]);
  EXPECT_EQ(scales[2], 1.0) << "a floe that overlaps nothing keeps its size";
  const double gap = convex_separation(drawn(floes[0], scales[0]), drawn(floes[1], scales[1]));
  EXPECT_NEAR(gap, 1e-6, 1e-9) << "they touch, but for the margin";
}

TEST(FloeScale, AFloeYieldsToAnObstacleAlone) {
  // Half side 2 over a wall at x = 1.5: it must lose a quarter.
  const std::vector<FrameFloe> floes = {floe_at(0, {0, 0}, 2)};
  EXPECT_NEAR(parting_scales(floes, {{{1.5, -9}, {9, -9}, {9, 9}, {1.5, 9}}})[0], 0.75, 1e-6);
}

TEST(FloeScale, TheDeepestOfSeveralOverlapsCounts) {
  std::vector<FrameFloe> floes;
  for (int i = 0; i < 5; ++i) floes.push_back(floe_at(std::size_t(i), {1.9 * i + (i > 2 ? -0.1 : 0.0), 0.3 * i}, 1));
  const std::vector<double> scales = parting_scales(floes, {});
  for (std::size_t a = 0; a < floes.size(); ++a)
    for (std::size_t b = a + 1; b < floes.size(); ++b)
      EXPECT_GT(convex_separation(drawn(floes[a], scales[a]), drawn(floes[b], scales[b])), 0.0) << a << ' ' << b;
  EXPECT_LT(scales[2], scales[0]);
}

TEST(FloeScale, FloesInsideEachOtherAreRefused) {
  const std::vector<FrameFloe> floes = {floe_at(7, {0, 0}, 1), floe_at(9, {0.1, 0}, 1)};
  try {
    parting_scales(floes, {});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("floe 7"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(parting_scales({}, {square(1)}).empty());
}

}  // namespace
}  // namespace gem
