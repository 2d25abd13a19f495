// The plan of the ensembles, the numbers of one run, and the verdicts.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "validation/baseline/ensemble_compare.h"
#include "validation/baseline/ensemble_plan.h"
#include "validation/baseline/ensemble_rows.h"
#include "validation/baseline/platform_events.h"

namespace gem::baseline {
namespace {

EnsemblePlan shipped_plan() { return read_plan(GEM_SOURCE_DIR "/validation/baseline/ensembles.txt"); }

TEST(EnsemblePlan, TheShippedOneComparesBothEnginesOverTwentyFields) {
  const EnsemblePlan plan = shipped_plan();
  ASSERT_EQ(plan.cases.size(), 3u);
  for (const char* label : {"gem", "Box2D 8/3"})
    for (const PlannedCase& chosen : plan.cases) EXPECT_GE(plan.members_of(plan.setting_labelled(label), chosen), 20);
  for (const PlannedQuantity& quantity : plan.quantities) EXPECT_GT(quantity.margin, 0.0) << quantity.name;
  EXPECT_EQ(plan.settings.front().label, "gem");
}

TEST(EnsemblePlan, FaultsNameTheirLine) {
  const ScratchFolder folder;
  const auto fault_of = [&](const std::string& text) -> std::string {
    try {
      read_plan(folder.write("bad.txt", text));
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(fault_of("# ok\ncase | a | b\n").find("bad.txt:2"), std::string::npos);
  EXPECT_NE(fault_of("part | p | twenty | a\n").find("twenty"), std::string::npos);
  EXPECT_NE(fault_of("colour | red\n").find("colour"), std::string::npos);
  EXPECT_NE(fault_of("# nothing\n").find("no plan"), std::string::npos);
  EXPECT_THROW(read_plan((folder.path() / "missing.txt").string()), Error);
}

/// Twelve runs about `mean` with a deviation of about `scatter`.
BySeed runs(double mean, double scatter) {
  BySeed values;
  for (int seed = 1; seed <= 12; ++seed) values[seed] = mean + scatter * std::sin(2.4 * seed);
  return values;
}

EnsemblePlan plan_of_one() {
  EnsemblePlan plan;
  plan.quantities = {{"load", 0.1, "load"}};
  return plan;
}

TEST(EnsembleCompare, SameWithinTheMarginBeyondItAndUndecided) {
  const auto verdict = [](double mean, double scatter) {
    return compare(plan_of_one(), {{"load", runs(100.0, scatter)}}, {{"load", runs(mean, scatter)}}).front();
  };
  const Compared same = verdict(102.0, 2.0);
  EXPECT_EQ(same.verdict, "equivalent");
  EXPECT_NEAR(same.margin, 10.0, 0.1);
  EXPECT_NEAR(same.paired_difference.value, 2.0, 1e-9);
  EXPECT_NEAR(same.difference.value, 2.0, 1e-9);
  EXPECT_EQ(verdict(130.0, 2.0).verdict, "beyond the margin");
  EXPECT_EQ(verdict(105.0, 40.0).verdict, "undecided");
}

TEST(EnsembleCompare, NumbersThatARunDoesNotHaveAreLeftOut) {
  BySeed holes = runs(100.0, 2.0);
  holes[3] = std::nan("");
  const Compared row = compare(plan_of_one(), {{"load", runs(100.0, 2.0)}}, {{"load", holes}}).front();
  EXPECT_EQ(row.runs, 11u);
  EXPECT_EQ(row.verdict, "equivalent");
  EXPECT_EQ(compare(plan_of_one(), {{"load", runs(1.0, 0.1)}}, {}).front().verdict, "too few runs");
}

TEST(PlatformEvents, AFloeThatRattlesLandsOnce) {
  // Floe 7 lands at 10 s, lies on the platform with gaps of at most 2 s, is jerked at 14 s, leaves, and returns at 30
  // s. Floe 8 lands slowly at 12 s.
  const PlatformEvents rows{{10.0, 10.1, 11.0, 12.0, 12.5, 14.0, 14.1, 15.5, 30.0},
                            {7.0, 7.0, 7.0, 8.0, 7.0, 7.0, 7.0, 7.0, 7.0},
                            {0.3, 0.1, 0.001, 0.005, 0.002, 0.02, 0.002, 0.001, 0.2}};
  EXPECT_EQ(first_after(landing_gap_s, rows, 0.0, 100.0), 3.0);
  EXPECT_EQ(first_after(landing_gap_s, rows, 10.5, 100.0), 2.0);  // the first landing lies before from_s
  EXPECT_EQ(first_after(landing_gap_s, rows, 0.0, 29.0), 2.0);
  EXPECT_EQ(first_after(1.0, rows, 0.0, 100.0), 6.0);  // a shorter gap splits a landing at its pauses
  const PlatformEvents fast = faster_than(0.01, rows);
  EXPECT_EQ(fast.time, (std::vector<double>{10.0, 10.1, 14.0, 30.0}));
  EXPECT_EQ(first_after(1.0, fast, 0.0, 100.0), 3.0);  // the jerk counts as a hit, floe 8 does not
  EXPECT_EQ(first_after(0.0, fast, 0.0, 100.0), 4.0);
}

TEST(EnsembleRows, OneHitOfOneFloe) {
  const ScratchFolder folder;
  const std::string file = (folder.path() / "run.h5").string();
  const std::string command = std::string(GEM_PROGRAM) + " run " + GEM_SOURCE_DIR +
                              "/cases/analytic/V10_floe_on_moored_platform.toml --engine cpu -q --overwrite "
                              "--until 60 --set contact.solver=coupled --set output.event_speed_m_per_s=0 -o " +
                              file;
  ASSERT_EQ(std::system(command.c_str()), 0);
  const PlannedCase chosen{"V10", "", 0, 0.0, 60.0};
  const MemberRows rows = member_rows(file, chosen, {{-105.0, -20.0}, 10.0, 6, 4});
  std::map<std::string, double> value;
  for (const MemberValue& v : rows.values) value[v.name] = v.value;
  EXPECT_NEAR(60.0 * value.at("hits_per_s"), 1.0, 1e-9);
  EXPECT_NEAR(60.0 * value.at("landings_per_s"), 1.0, 1e-9);
  EXPECT_GE(value.at("impacts_per_s"), value.at("hits_per_s"));
  EXPECT_GT(value.at("offset_x_mean_m"), 0.0);
  EXPECT_NEAR(60.0 * value.at("energy_loss_W"), 1405.6, 10.0);  // V10.dE
  double area = 0.0;
  for (const double share : rows.share) area += 100.0 * share;
  EXPECT_NEAR(area, 100.0, 1e-3);                                         // the floe of 10 m x 10 m
  EXPECT_THROW(member_rows(file, {"V10", "", 0, 0.0, 90.0}, {}), Error);  // the run ends before the judged time
}

}  // namespace
}  // namespace gem::baseline
