// Shares of cells by hand, and the total area of a field of floes.
#include "gem/analysis/concentration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

const std::vector<Vec2> kSquare = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};

TEST(Concentration, OfASquareOnACorner) {
  const std::vector<PlacedFloe> floes = {{kSquare, {2.5, 2.0}, 0.0}};
  const Concentration map = concentration(floes, {{0.0, 0.0}, 2.0, 3, 2});
  // x from 1.5 to 3.5, y from 1 to 3 in cells of 2 m.
  EXPECT_NEAR(map.at(0, 0), 0.5 * 1.0 / 4.0, 1e-15);
  EXPECT_NEAR(map.at(1, 0), 1.5 * 1.0 / 4.0, 1e-15);
  EXPECT_NEAR(map.at(0, 1), 0.5 * 1.0 / 4.0, 1e-15);
  EXPECT_NEAR(map.at(1, 1), 1.5 * 1.0 / 4.0, 1e-15);
  EXPECT_EQ(map.at(2, 0), 0.0);
}

// Turned by 45 degrees, the square is a diamond that extends beyond its cell by a triangle of height sqrt(2) - 1.
TEST(Concentration, OfATurnedSquare) {
  const std::vector<PlacedFloe> floes = {{kSquare, {3.0, 3.0}, std::numbers::pi / 4.0}};
  const Concentration map = concentration(floes, {{0.0, 0.0}, 2.0, 3, 3});
  const double reach = std::sqrt(2.0) - 1.0;
  EXPECT_NEAR(map.at(0, 1), reach * reach / 4.0, 1e-15);
  EXPECT_NEAR(map.at(1, 1), (4.0 - 4.0 * reach * reach) / 4.0, 1e-14);
  EXPECT_EQ(map.at(0, 0), 0.0);
}

TEST(Concentration, LeavesOutWhatIsOutside) {
  const std::vector<PlacedFloe> floes = {{kSquare, {0.0, 0.0}, 0.0}, {kSquare, {-9.0, 50.0}, 0.0}};
  const Concentration map = concentration(floes, {{0.0, 0.0}, 1.0, 4, 4});
  EXPECT_EQ(map.at(0, 0), 1.0);
  EXPECT_EQ(std::accumulate(map.share.begin(), map.share.end(), 0.0), 1.0);
  EXPECT_THROW(concentration(floes, {{0.0, 0.0}, 0.0, 4, 4}), std::invalid_argument);
}

// No area is lost or counted twice for any cell size: 300 hexagons of 2.598 m2 each.
TEST(Concentration, KeepsTheTotalArea) {
  std::vector<Vec2> hexagon;
  for (int i = 0; i < 6; ++i) hexagon.push_back({std::cos(kTestTurn * i / 6.0), std::sin(kTestTurn * i / 6.0)});
  RandomSequence random = test_random(3);
  std::vector<PlacedFloe> floes;
  for (int i = 0; i < 300; ++i)
    floes.push_back({hexagon, {random.uniform(2.0, 98.0), random.uniform(2.0, 48.0)}, random.uniform(0.0, kTestTurn)});
  for (const double cell : {0.3, 1.0, 7.0, 100.0}) {
    const auto count = [cell](double length) { return static_cast<std::size_t>(std::ceil(length / cell)); };
    const Concentration map = concentration(floes, {{0.0, 0.0}, cell, count(100.0), count(50.0)});
    const double area = std::accumulate(map.share.begin(), map.share.end(), 0.0) * cell * cell;
    EXPECT_NEAR(area, 300.0 * 1.5 * std::sqrt(3.0), 1e-9) << cell;
  }
}

}  // namespace
}  // namespace gem
