// Artificial seeds: growth, steadiness and extremes are found where they exist, and only there.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/paper/studies/day_study.h"
#include "validation/paper/studies/seed_extremes.h"
#include "validation/paper/studies/stationarity.h"

namespace gem {
namespace {

/// The swings of 600 s blocks: the first is given, each next is larger by a factor.
PaperRun growing(std::uint64_t seed, double first_m, double factor, std::size_t blocks) {
  PaperRun run;
  run.seed = seed;
  run.numbers.add("duration_s", kBlockLength * static_cast<double>(blocks));
  double swing = first_m;
  for (std::size_t i = 0; i < blocks; ++i, swing *= factor) {
    run.blocks.mean_x.push_back(0.1 * static_cast<double>(i));
    run.blocks.deviation_x.push_back(swing);
    run.blocks.deviation_y.push_back(first_m);
    run.blocks.largest_excursion.push_back(3.0 * swing);
    run.blocks.largest_ice_force.push_back(1e5);
  }
  return run;
}

PaperFolder seeds(double factor, double scatter) {
  PaperFolder folder;
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    folder.conditions["a"].push_back(
        growing(seed, 0.01 * static_cast<double>(seed), factor + scatter * (static_cast<double>(seed % 4) - 1.5), 5));
  return folder;
}

TEST(Stationarity, FindsGrowthWhateverTheSizeOfTheSeeds) {
  const std::vector<StationarityRow> rows = stationarity(seeds(1.2, 0.01), {"a", "none"});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].seeds, 8U);
  EXPECT_EQ(rows[0].half_s, 1200.0);
  EXPECT_EQ(rows[0].growth, Growth::grows);
  EXPECT_NEAR(rows[0].ratio_x.value, std::pow(1.2, 3), 0.01) << "the middle block of five belongs to neither half";
  EXPECT_NEAR(rows[0].ratio_y.value, 1.0, 1e-12);
  EXPECT_NEAR(rows[0].offset_shift_m.value, 0.3, 1e-12);
}

TEST(Stationarity, SteadyAndUndecidedAreTwoThings) {
  EXPECT_EQ(stationarity(seeds(1.0, 0.005), {"a"})[0].growth, Growth::steady);
  EXPECT_EQ(stationarity(seeds(1.0, 0.2), {"a"})[0].growth, Growth::undecided);
  EXPECT_EQ(stationarity(seeds(0.8, 0.01), {"a"})[0].growth, Growth::shrinks);
  PaperFolder few = seeds(1.2, 0.01);
  few.conditions["a"].resize(4);
  EXPECT_EQ(stationarity(few, {"a"})[0].growth, Growth::grows);
  few.conditions["a"].resize(3);
  ASSERT_GT(stationarity(few, {"a"})[0].ratio_x.low, 1.0);
  EXPECT_EQ(stationarity(few, {"a"})[0].growth, Growth::undecided) << "three seeds decide nothing";
  PaperFolder one = seeds(1.2, 0.0);
  one.conditions["a"].resize(1);
  EXPECT_TRUE(stationarity(one, {"a"}).empty());
}

TEST(Stationarity, BlocksOfASineHaveItsDeviationAndSize) {
  PlatformSeries series;
  series.interval = 0.5;
  for (std::size_t i = 0; i < 3000; ++i) {  // 1500 s: two blocks and a remainder
    const double t = 0.5 * static_cast<double>(i);
    const double amplitude = t < 600.0 ? 1.0 : 2.0;
    series.x.push_back(0.25 + amplitude * std::sin(2.0 * std::numbers::pi * t / 60.0));
    series.y.push_back(0.0);
    series.ice_force_window_x.push_back(t < 600.0 ? -7.0 : 3.0);
    series.ice_force_window_y.push_back(0.0);
  }
  const RunBlocks blocks = run_blocks(series);
  ASSERT_EQ(blocks.count(), 2U);
  EXPECT_NEAR(blocks.mean_x[0], 0.25, 1e-12);
  EXPECT_NEAR(blocks.deviation_x[1], std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(blocks.largest_excursion[0], 1.25, 1e-12);
  EXPECT_EQ(blocks.largest_ice_force[0], 7.0);
  EXPECT_EQ(blocks.largest_ice_force[1], 3.0);
}

TEST(DayStudy, TellsTheFirstHoursFromTheRest) {
  PaperFolder folder;
  PaperRun run = growing(1, 0.02, 1.0, 6 * 24);
  for (std::size_t k = 0; k < 12; ++k) run.blocks.deviation_x[k] = 0.01;
  for (std::size_t k = 12; k < run.blocks.count(); ++k) run.blocks.mean_x[k] = 0.5;
  run.blocks.largest_excursion[100] = 0.7;
  folder.conditions["day_a"].push_back(run);
  folder.conditions["a"].push_back(growing(1, 0.02, 1.0, 144));
  folder.conditions["day_short"].push_back(growing(1, 0.02, 1.0, 30));
  const std::vector<DayRow> days = day_study(folder);
  ASSERT_EQ(days.size(), 1U);
  EXPECT_EQ(days[0].day, "day_a");
  EXPECT_EQ(days[0].condition, "a");
  EXPECT_EQ(days[0].hours, 24.0);
  EXPECT_NEAR(days[0].first.value, 0.01, 1e-15);
  EXPECT_NEAR(days[0].middle.value, 0.02, 1e-15);
  EXPECT_NEAR(days[0].last.high, 0.02, 1e-15);
  EXPECT_NEAR(days[0].mean_x.value, 0.5, 1e-15);
  EXPECT_EQ(days[0].largest_excursion, 0.7);
}

TEST(SeedExtremes, FindTheQuantileOfAGumbelLaw) {
  // Maxima of blocks that are quantiles of a Gumbel law: its p90 over one and over two blocks is known.
  PaperFolder folder;
  const std::size_t runs = 50;
  for (std::size_t i = 0; i < runs; ++i) {
    PaperRun run = growing(i + 1, 1.0, 1.0, 2);
    for (std::size_t block = 0; block < 2; ++block) {
      const double p = (static_cast<double>(2 * i + block) + 0.5) / (2.0 * runs);
      run.blocks.largest_excursion[block] = 10.0 - 2.0 * std::log(-std::log(p));
    }
    run.numbers.add("orbit_largest_m", largest_so_far(run.blocks).back());
    run.numbers.add("ice_peak_window_N", 1e5);
    folder.conditions["a"].push_back(run);
  }
  const std::vector<ExtremesRow> rows = seed_extremes(folder, {"a"});
  ASSERT_EQ(rows.size(), 1U);
  ASSERT_TRUE(rows[0].by_block_m);
  const double expected = 10.0 + 2.0 * std::log(2.0) - 2.0 * std::log(-std::log(0.9));
  EXPECT_NEAR(rows[0].by_block_m->value, expected, 0.1);
  EXPECT_TRUE(rows[0].by_block_m->holds(expected));
  EXPECT_FALSE(rows[0].by_acer_m) << "no peaks were given";
  EXPECT_FALSE(rows[0].force_p90_N) << "all forces are alike: no law";
}

TEST(SeedExtremes, NeedFiveSeeds) {
  PaperFolder folder = seeds(1.0, 0.0);
  for (PaperRun& run : folder.conditions["a"]) run.numbers.add("orbit_largest_m", 0.03 * static_cast<double>(run.seed));
  EXPECT_EQ(seed_extremes(folder, {"a"}).size(), 1U);
  folder.conditions["a"].resize(4);
  EXPECT_TRUE(seed_extremes(folder, {"a"}).empty());
}

TEST(SeedExtremes, TheLargestSoFarNeverFalls) {
  RunBlocks blocks;
  blocks.largest_excursion = {2.0, 1.0, 3.0};
  EXPECT_EQ(largest_so_far(blocks), (std::vector<double>{2.0, 2.0, 3.0}));
}

}  // namespace
}  // namespace gem
