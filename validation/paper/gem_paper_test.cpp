// The program as users start it: a collected sweep is judged like its run files.
#include <gtest/gtest.h>

#include <filesystem>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/record/summary/summary_file.h"
#include "gem/report/figures/run_program.h"
#include "validation/paper/runs/paper_run.h"
#include "validation/paper/runs/paper_summary.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

class GemPaper : public ::testing::Test {
 protected:
  ProgramResult call(std::vector<std::string> words) { return run_program(words, folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  ScratchFolder scratch_{"gem_paper_program"};
  const fs::path& folder_ = scratch_.path();
};

TEST_F(GemPaper, ItsSummariesStandForTheRunFiles) {
  const std::string sweep = std::string(GEM_SOURCE_DIR) + "/cases/small_sweep.toml";
  ASSERT_EQ(call({GEM_PROGRAM, "sweep", "run", sweep, "--threads", "1", "--quiet", "--out", "runs"}).exit_code, 0);
  const ProgramResult collected = call({GEM_PAPER_PROGRAM, "collect", "runs", "--out", "summary.h5"});
  ASSERT_EQ(collected.exit_code, 0) << collected.output;
  const PaperFolder files = read_paper_folders({path("runs")});
  const PaperFolder summary = read_paper_folders({path("summary.h5")});
  ASSERT_EQ(files.conditions.size(), 6U);
  ASSERT_EQ(summary.conditions.size(), 6U);
  for (const auto& [condition, runs] : files.conditions) {
    ASSERT_EQ(summary.of(condition).size(), 1U) << condition;
    const PaperRun& kept = summary.of(condition).front();
    EXPECT_EQ(kept.state_hash, runs.front().state_hash);
    EXPECT_EQ(kept.case_toml, runs.front().case_toml);
    EXPECT_EQ(kept.source, runs.front().source);
    ASSERT_GT(runs.front().numbers.all().size(), 20U);
    for (const auto& [name, number] : runs.front().numbers.all()) {
      ASSERT_TRUE(kept.numbers.find(name)) << name;
      EXPECT_EQ(kept.numbers.find(name)->value, number.value) << name;
    }
  }
}

TEST_F(GemPaper, APlainSummaryIsRefused) {
  const std::string sweep = std::string(GEM_SOURCE_DIR) + "/cases/small_sweep.toml";
  ASSERT_EQ(call({GEM_PROGRAM, "sweep", "run", sweep, "--threads", "1", "--quiet", "--out", "runs", "--index", "1"})
                .exit_code,
            0);
  ASSERT_EQ(call({GEM_PROGRAM, "sweep", "collect", "runs", "--partial", "--out", "plain.h5"}).exit_code, 0);
  EXPECT_THROW(paper_runs(read_summary(path("plain.h5")), "plain.h5"), Error);
  const ProgramResult judged = call({GEM_PAPER_PROGRAM, "judge", "plain.h5", "--out", "page", "--statements",
                                     std::string(GEM_SOURCE_DIR) + "/validation/paper/paper.json"});
  EXPECT_EQ(judged.exit_code, static_cast<int>(ExitCode::file_system));
  EXPECT_NE(judged.output.find("gem sweep collect"), std::string::npos) << judged.output;
}

TEST_F(GemPaper, TheFormerCommandNamesIt) {
  const ProgramResult result = call({GEM_PROGRAM, "paper", "runs", "--out", "page"});
  EXPECT_EQ(result.exit_code, static_cast<int>(ExitCode::usage));
  EXPECT_NE(result.output.find("gem_paper judge"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace gem
