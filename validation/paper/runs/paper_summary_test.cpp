// Runs are read back from a summary unchanged, and a run that is found twice counts once.
#include "validation/paper/runs/paper_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/report/run/summary_series.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

PaperRun made_up(std::uint64_t seed, const std::string& hash) {
  PaperRun run;
  run.case_toml = "[run]\nname = \"a_s" + std::to_string(seed) + "\"\nseed = " + std::to_string(seed) + "\n";
  run.source = "gem test";
  run.resolution = "coupled";
  run.state_hash = hash;
  run.numbers.add("duration_s", 1200.0 + static_cast<double>(seed));
  run.numbers.add("x_offset_m", RunNumber{0.5, 0.4, 0.6, true});
  if (seed == 1) run.numbers.add("x_change_p", 0.25);
  run.excursion_peaks = {0.5, 0.25, 0.75};
  run.blocks.mean_x = {0.125, 0.25};
  run.blocks.deviation_x = run.blocks.deviation_y = run.blocks.largest_excursion = {1.0, 2.0};
  run.blocks.largest_ice_force = {1e5, 2e5};
  run.path = PlatformPath{5.0, true, {0.0, 1.0 / 3.0, 1e-9}, {0.0, 0.1, 0.2}, {0.0, 0.3, 0.4}, {0.0, 0.5, 0.6}};
  if (seed == 2) {  // a shorter run
    run.excursion_peaks.pop_back();
    run.blocks = RunBlocks{{0.125}, {1.0}, {1.0}, {1.0}, {1e5}};
    run.path = PlatformPath{5.0, true, {0.0}, {0.0}, {0.0}, {0.0}};
  }
  return run;
}

SummaryTable table_of(const std::vector<PaperRun>& runs) {
  SummaryTable table;
  SummaryColumn hashes{"state_hash", "", "hash"}, engines{"engine", "", "engine"};
  SummaryColumn sources{"source", "", "source"}, resolutions{"resolution", "", "resolution"};
  for (const PaperRun& run : runs) {
    table.runs.push_back("run " + std::to_string(run.numbers.find("duration_s")->value));
    hashes.texts.push_back(run.state_hash);
    engines.texts.emplace_back("cpu");
    sources.texts.push_back(run.source);
    resolutions.texts.push_back(run.resolution);
  }
  table.columns = {
      hashes, engines, sources, resolutions, {"gap_m", "m", "gap", true, std::vector<double>(runs.size(), 400.0)}};
  add_paper_part(table, runs);
  add_series(table, {runs.begin(), runs.end()});
  return table;
}

class PaperSummary : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::vector<PaperRun>& runs) {
    const std::string path = (folder_ / name).string();
    write_summary(path, true, table_of(runs));
    return path;
  }
  ScratchFolder scratch_{"gem_summary"};
  const fs::path& folder_ = scratch_.path();
};

TEST_F(PaperSummary, BringsEveryRunBack) {
  const std::string path = write("s.h5", {made_up(1, "aa"), made_up(2, "bb")});
  const std::vector<PaperRun> runs = paper_runs(read_summary(path), path);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[1].condition, "a");
  EXPECT_EQ(runs[1].seed, 2U);
  EXPECT_EQ(runs[1].state_hash, "bb");
  EXPECT_EQ(runs[1].engine, "cpu");
  EXPECT_TRUE(runs[1].file.empty());
  EXPECT_EQ(runs[0].numbers.find("duration_s")->value, 1201.0);
  EXPECT_FALSE(runs[0].numbers.find("duration_s")->interval);
  const RunNumber offset = *runs[0].numbers.find("x_offset_m");
  EXPECT_TRUE(offset.interval);
  EXPECT_EQ(offset.low, 0.4);
  EXPECT_EQ(offset.high, 0.6);
  EXPECT_TRUE(runs[0].numbers.find("x_change_p"));
  EXPECT_FALSE(runs[1].numbers.find("x_change_p"));
  EXPECT_FALSE(runs[0].numbers.find("gap_m")) << "a setting is no result";
  EXPECT_EQ(runs[0].excursion_peaks, (std::vector<double>{0.5, 0.25, 0.75}));
  EXPECT_EQ(runs[1].excursion_peaks.size(), 2U);
  EXPECT_EQ(runs[0].blocks.largest_ice_force, (std::vector<double>{1e5, 2e5}));
  EXPECT_EQ(runs[1].blocks.count(), 1U);
  ASSERT_TRUE(runs[0].path);
  EXPECT_TRUE(runs[0].path->exact);
  EXPECT_EQ(runs[0].path->interval_s, 5.0);
  EXPECT_EQ(runs[0].path->x, (std::vector<double>{0.0, 1.0 / 3.0, 1e-9})) << "to the last bit";
  EXPECT_EQ(runs[0].path->vy.back(), 0.6);
  EXPECT_EQ(runs[1].path->x.size(), 1U);
}

TEST_F(PaperSummary, TheSameRunTwiceCountsOnceAndIsCompleted) {
  PaperRun lean = made_up(1, "aa");
  lean.numbers = {};
  lean.numbers.add("duration_s", 1201.0);
  lean.blocks = {};
  const PaperFolder folder = read_paper_folders(
      {write("1.h5", {lean, made_up(2, "bb")}), write("2.h5", {made_up(1, "aa"), made_up(2, "cc")})});
  ASSERT_EQ(folder.of("a").size(), 2U);
  EXPECT_EQ(folder.repeated, 1U);
  ASSERT_EQ(folder.refused.size(), 1U) << "another state hash is another run";
  EXPECT_NE(folder.refused[0].find("cc"), std::string::npos);
  EXPECT_TRUE(folder.of("a")[0].numbers.find("x_offset_m"));
  EXPECT_EQ(folder.of("a")[0].blocks.count(), 2U);
}

TEST_F(PaperSummary, ASummaryWithoutItsPaperPartIsRefused) {
  SummaryTable table = table_of({made_up(1, "aa")});
  std::erase_if(table.columns, [](const SummaryColumn& column) { return column.name == "case_toml"; });
  EXPECT_THROW(paper_runs(table, "s.h5"), Error);
}

TEST_F(PaperSummary, WhatDoesNotFitTogetherIsRefused) {
  const auto refused = [](const std::function<void(SummaryTable&)>& spoil) {
    SummaryTable table = table_of({made_up(1, "aa"), made_up(2, "bb")});
    spoil(table);
    try {
      paper_runs(table, "s.h5");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto series = [](SummaryTable& table, const std::string& name) -> SummarySeries& {
    return *std::find_if(table.series.begin(), table.series.end(), [&](const auto& one) { return one.name == name; });
  };
  EXPECT_EQ(refused([](SummaryTable&) {}), "");
  EXPECT_NE(refused([&](SummaryTable& t) { series(t, "displacement_x").axis = "block"; }).find("along time"),
            std::string::npos);
  EXPECT_NE(refused([&](SummaryTable& t) { series(t, "displacement_y").values[1] = std::nan(""); }).find("length"),
            std::string::npos);
  EXPECT_NE(refused([](SummaryTable& t) {
              for (SummaryAxis& axis : t.axes) std::fill(axis.values.begin(), axis.values.end(), 0.0);
            }).find("do not increase"),
            std::string::npos);
  EXPECT_NE(refused([](SummaryTable& t) {
              std::erase_if(t.columns, [](const SummaryColumn& column) { return column.name == "duration_s"; });
            }).find("duration_s"),
            std::string::npos);
}

TEST(PlatformPath, OfOneSampleHasNothingToThin) {
  EXPECT_EQ(thinned({0.0, true, {1.0}, {2.0}, {}, {}}, 5.0).x, (std::vector<double>{1.0}));
}

TEST(PlatformPath, IsThinnedByWholeSteps) {
  const PlatformPath path{1.0, true, {0, 1, 2, 3, 4}, {0, 1, 2, 3, 4}, {}, {}};
  EXPECT_EQ(thinned(path, 2.0).x, (std::vector<double>{0, 2, 4}));
  EXPECT_EQ(thinned(path, 2.0).interval_s, 2.0);
  EXPECT_EQ(thinned(path, 2.5).interval_s, 1.0) << "no multiple: as it is";
}

}  // namespace
}  // namespace gem
