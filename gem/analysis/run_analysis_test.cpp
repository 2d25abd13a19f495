// The list of findings on a platform whose motion is known, and its combination over runs.
#include "gem/analysis/run_analysis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gem/analysis/runs_analysis.h"
#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

const Finding& named(const std::vector<Finding>& findings, const std::string& name) {
  const auto found =
      std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) { return finding.name == name; });
  if (found == findings.end()) throw std::out_of_range(name);
  return *found;
}

/// Circles of 0.3 m about (0.5, 0) m with a period of 90 s, in contact for 1 s of every 10.
PlatformSeries circling(std::size_t samples) {
  PlatformSeries series;
  series.interval = 1.0;
  series.natural_period = 90.0;
  series.x = sum_of(sine(samples, 90.0, 0.3, 0.5 * std::numbers::pi), std::vector<double>(samples, 0.5));
  series.y = sine(samples, 90.0, 0.3);
  for (std::size_t i = 0; i < samples; ++i) series.contacts.push_back(i % 10 == 3 ? 2.0 : 0.0);
  series.ice_force_x.assign(samples, 1000.0);
  series.ice_force_y.assign(samples, 0.0);
  series.ice_force_window_x.assign(samples, 3000.0);
  series.ice_force_window_y.assign(samples, 4000.0);
  series.mooring_force_x.assign(samples, -6000.0);
  series.mooring_force_y.assign(samples, 8000.0);
  return series;
}

TEST(AnalysePlatform, OfACirclingPlatform) {
  const auto findings = analyse_platform(circling(3600));
  const auto value = [&](const std::string& name) { return named(findings, name).value.value(); };
  EXPECT_NEAR(value("x_offset_m"), 0.5, 1e-12);
  EXPECT_TRUE(named(findings, "x_offset_m").interval->holds(0.5));
  EXPECT_NEAR(value("x_deviation_m"), 0.3 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(value("x_largest_m"), 0.8, 1e-12);
  EXPECT_FALSE(named(findings, "x_largest_m").interval.has_value());
  for (const std::string axis : {"x", "y"}) {
    for (const std::string way : {"spectrum", "crossings", "maxima"}) {
      const Finding& period = named(findings, axis + "_period_by_" + way + "_s");
      EXPECT_TRUE(period.interval->holds(90.0) || std::abs(*period.value - 90.0) < 1e-9) << period.name;
    }
    EXPECT_NEAR(value(axis + "_amplitude_median_m"), 0.3, 1e-3);
    EXPECT_NEAR(value(axis + "_period_of_large_amplitudes_s"), 90.0, 0.1);
    EXPECT_NEAR(value(axis + "_line_period_s"), 90.0, 0.2);
  }
  EXPECT_NEAR(value("orbit_turning"), 1.0, 2e-3);
  EXPECT_NEAR(value("orbit_largest_m"), 0.8, 1e-12);
  EXPECT_NEAR(value("contact_fraction"), 0.1, 1e-12);
  EXPECT_NEAR(value("contact_spell_mean_s"), 1.0, 1e-12);
  EXPECT_NEAR(value("contact_gap_median_s"), 9.0, 1e-12);
  EXPECT_NEAR(value("contact_gap_mean_s"), 9.0, 1e-12);
  EXPECT_EQ(value("contact_spells_cut"), 0.0);
  EXPECT_EQ(value("contact_gaps_cut"), 2.0);
  EXPECT_NEAR(value("contact_gap_longest_at_least_s"), 9.0, 1e-12);
  EXPECT_NEAR(value("ice_force_x_mean_N"), 1000.0, 1e-9);
  EXPECT_NEAR(value("mooring_force_x_mean_N"), -6000.0, 1e-9);
  EXPECT_NEAR(value("mooring_force_y_mean_N"), 8000.0, 1e-9);
  EXPECT_TRUE(named(findings, "mooring_force_y_mean_N").interval->holds(8000.0));
  EXPECT_NEAR(value("ice_force_window_largest_N"), 5000.0, 1e-9);
  EXPECT_NEAR(value("mooring_force_largest_N"), 1e4, 1e-9);
}

TEST(AnalysePlatform, OfAPlatformAtRestHasNoPeriods) {
  PlatformSeries series = circling(100);
  series.x.assign(100, 0.0);
  series.y.assign(100, 0.0);
  const auto findings = analyse_platform(series);
  EXPECT_FALSE(named(findings, "x_period_by_spectrum_s").value.has_value());
  EXPECT_FALSE(named(findings, "y_line_period_s").value.has_value());
  EXPECT_FALSE(named(findings, "x_offset_m").interval.has_value());
  EXPECT_EQ(named(findings, "orbit_largest_m").value, 0.0);
  EXPECT_EQ(findings.size(), analyse_platform(circling(3600)).size());
}

TEST(AnalysePlatform, HasTheDragWhereItActs) {
  PlatformSeries series = circling(3600);
  EXPECT_FALSE(finding_of(analyse_platform(series), "drag_force_x_mean_N").value.has_value());
  series.drag_force_x = sum_of(sine(3600, 90.0, 500.0), std::vector<double>(3600, 2000.0));
  series.drag_force_y.assign(3600, -300.0);
  const auto findings = analyse_platform(series);
  EXPECT_NEAR(named(findings, "drag_force_x_mean_N").value.value(), 2000.0, 1e-9);
  EXPECT_TRUE(named(findings, "drag_force_x_mean_N").interval->holds(2000.0));
  EXPECT_NEAR(named(findings, "drag_force_y_mean_N").value.value(), -300.0, 1e-9);
  series.drag_force_y.pop_back();
  EXPECT_THROW(analyse_platform(series), std::invalid_argument);
}

TEST(AnalysePlatform, RefusesShortOrUnequalColumns) {
  EXPECT_THROW(analyse_platform(circling(63)), std::invalid_argument);
  PlatformSeries series = circling(100);
  series.contacts.pop_back();
  EXPECT_THROW(analyse_platform(series), std::invalid_argument);
}

// Few runs get Student's interval: for two runs the half width is 12.706 times the deviation over sqrt(2).
TEST(CombineRuns, OfTwo) {
  const auto rows = combine_runs({{{"x", 1.0, std::nullopt}}, {{"x", 3.0, std::nullopt}}});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_DOUBLE_EQ(rows[0].mean->value, 2.0);
  EXPECT_NEAR(rows[0].mean->high, 2.0 + 12.7062, 1e-4);
  EXPECT_NEAR(rows[0].mean->low, 2.0 - 12.7062, 1e-4);
}

TEST(CombineRuns, TakesTheSizeOfLargestExcursions) {
  const auto rows = combine_runs({{{"x_largest_m", -1.0, std::nullopt}}, {{"x_largest_m", 3.0, std::nullopt}}});
  EXPECT_DOUBLE_EQ(rows[0].mean->value, 2.0);
  EXPECT_DOUBLE_EQ(rows[0].smallest, 1.0);
}

TEST(AnalysePlatform, FindsNoPeriodInRounding) {
  PlatformSeries series = circling(2000);
  for (double& x : series.x) x *= 1e-14;
  const std::vector<Finding> findings = analyse_platform(series);
  for (const char* name : {"x_period_by_spectrum_s", "x_period_by_crossings_s", "x_period_by_maxima_s"})
    EXPECT_FALSE(finding_of(findings, name).value.has_value()) << name;
  EXPECT_TRUE(finding_of(findings, "y_period_by_spectrum_s").value.has_value());
}

// Eight runs of a driven oscillator: the period has an interval over runs, and the extremes follow the Gumbel law.
TEST(CombineRuns, OfADrivenOscillator) {
  std::vector<std::vector<Finding>> runs;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    PlatformSeries series = circling(2000);
    series.x = driven_oscillator(2000, 90.0, 0.02, seed);
    runs.push_back(analyse_platform(series));
  }
  const auto rows = combine_runs(runs);
  ASSERT_EQ(rows.size(), runs.front().size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i].name, runs.front()[i].name);
  const auto period = std::find_if(rows.begin(), rows.end(),
                                   [](const RunsFinding& row) { return row.name == "x_period_by_spectrum_s"; });
  EXPECT_EQ(period->runs, 8u);
  EXPECT_TRUE(period->mean->holds(90.0));
  EXPECT_GT(period->deviation, 0.0);
  const auto extreme = extreme_of(runs, "x_largest_m");
  ASSERT_TRUE(extreme.has_value());
  EXPECT_DOUBLE_EQ(extreme->most_probable.value, extreme->by_likelihood.mode);
  EXPECT_GT(extreme->p90.value, extreme->most_probable.value);
  EXPECT_GT(extreme->p90.high, extreme->p90.low);
  runs.resize(4);
  EXPECT_FALSE(extreme_of(runs, "x_largest_m").has_value());
  runs[1].pop_back();
  EXPECT_THROW(combine_runs(runs), std::invalid_argument);
}

}  // namespace
}  // namespace gem
