// The extract of a report lies where most impacts are, or where the user wants it.
#include "gem/report/figures/force_window.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

/// 1000 s with the largest force at 100 s; impacts of different floes at the given times.
RunData run_with_impacts(const std::vector<double>& times) {
  RunData run;
  for (int i = 0; i <= 1000; ++i) {
    run.platform.time.push_back(i);
    run.platform.ice_force_x.push_back(i == 100 ? 9.0 : i == 600 ? -5.0 : 0.0);
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    run.events.time.push_back(times[i]);
    run.events.body_b.push_back(static_cast<std::int32_t>(i + 1));
  }
  return run;
}

TEST(ForceWindow, HoldsMostImpactsInItsMiddle) {
  const TimeWindow window = force_window(run_with_impacts({100, 310, 300, 320, 306}), 33.0);
  EXPECT_DOUBLE_EQ(window.from, 310.0 - 16.5);
  EXPECT_DOUBLE_EQ(window.to, 310.0 + 16.5);
}

TEST(ForceWindow, TakesTheLargerForceAmongEquals) {
  EXPECT_DOUBLE_EQ(force_window(run_with_impacts({300, 301, 600, 601}), 33.0).from, 600.5 - 16.5);
  EXPECT_DOUBLE_EQ(force_window(run_with_impacts({600, 601, 300, 301}), 33.0).from, 600.5 - 16.5);
}

TEST(ForceWindow, AFloeThatRestsIsOneImpact) {
  RunData run = run_with_impacts({300, 300.5, 301, 301.5, 700, 710});
  for (std::size_t i = 0; i < 4; ++i) run.events.body_b[i] = 1;
  EXPECT_DOUBLE_EQ(force_window(run, 33.0).from, 705.0 - 16.5);
}

TEST(ForceWindow, WithoutImpactsShowsTheLargestForce) {
  EXPECT_DOUBLE_EQ(force_window(run_with_impacts({}), 33.0).from, 100.0 - 16.5);
  EXPECT_DOUBLE_EQ(force_window(run_with_impacts({2000.0}), 33.0).from, 100.0 - 16.5) << "beyond the record";
}

TEST(ForceWindow, LiesAroundTheChosenTimeInsideTheRecord) {
  RunData run = run_with_impacts({300, 301});
  run.at_s = 500.0;
  EXPECT_DOUBLE_EQ(force_window(run, 33.0).from, 483.5);
  run.at_s = 0.0;
  EXPECT_DOUBLE_EQ(force_window(run, 33.0).from, 0.0);
  run.at_s = 1000.0;
  EXPECT_DOUBLE_EQ(force_window(run, 33.0).to, 1000.0);
  EXPECT_DOUBLE_EQ(force_window(run, 5000.0).to, 1000.0) << "the record is shorter";
}

}  // namespace
}  // namespace gem
