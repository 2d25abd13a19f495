// How runs are divided into batches, and what they need.
#include "gem/command/sweep/sweep_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "gem/base/scratch_folder.h"

namespace gem {
namespace {

using Batches = std::vector<std::vector<std::size_t>>;

TEST(SweepPlan, WithoutAGpuEachRunIsMadeByItself) { EXPECT_EQ(share_runs({5, 5, 7}, 0), (Batches{{0}, {1}, {2}})); }

TEST(SweepPlan, RunsOfAnyLengthShareAGpu) { EXPECT_EQ(share_runs({5, 9, 5}, 1), (Batches{{0, 1, 2}})); }

TEST(SweepPlan, SeveralGpusGetLongAndShortRunsAlike) {
  EXPECT_EQ(share_runs({5, 9, 5, 9}, 2), (Batches{{0, 1}, {2, 3}}));
  EXPECT_EQ(share_runs({5}, 8), (Batches{{0}}));
}

TEST(SweepPlan, EveryGpuHasItsProcessWhateverItsThreads) {
  EXPECT_EQ(open_jobs(8, true, 16, 16), 8);
  EXPECT_EQ(open_jobs(8, true, 4, 0), 8);
}

TEST(SweepPlan, WithoutGpusProcessesTimesThreadsFillTheProcessors) {
  EXPECT_EQ(open_jobs(100, false, 16, 4), 4);
  EXPECT_EQ(open_jobs(100, false, 16, 0), 16);
  EXPECT_EQ(open_jobs(100, false, 16, 32), 1);
  EXPECT_EQ(open_jobs(3, false, 16, 1), 3);
}

TEST(SweepPlan, NoBatchIsTooLargeAndNoRunIsLost) {
  const Batches batches = share_runs(std::vector<std::int64_t>(200, 3), 2);
  std::vector<std::size_t> all;
  for (const auto& batch : batches) {
    EXPECT_LE(batch.size(), 66u);
    all.insert(all.end(), batch.begin(), batch.end());
  }
  std::sort(all.begin(), all.end());
  ASSERT_EQ(all.size(), 200u);
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k], k);
}

/// Disk for eight runs of 4000 and more floes, two at a time [bytes].
double disk_of_sweep(double checkpoint_interval_s) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / "s.toml")
      << "[sweep]\nmode = \"product\"\nname = \"{count}\"\nmap = { count = \"floes.count\" }\n"
         "count = [4000, 4001, 4002, 4003, 4004, 4005, 4006, 4007]\n";
  SweepRunChoice choice;
  choice.path = (folder.path() / "s.toml").string();
  choice.folder = (folder.path() / "out").string();
  choice.engine = "cpu";
  choice.jobs = "2";
  choice.checkpoint_interval_s = checkpoint_interval_s;
  RunLog log({ProgressMode::none, true, false});
  return plan_sweep(choice, log).need.disk;
}

TEST(SweepPlan, CheckpointsStandOnlyForTheRunsThatRunAtOneTime) {
  SceneDef largest, second;
  largest.floes.count = 4007;
  second.floes.count = 4006;
  const double expected = estimate(largest, true).checkpoint_disk + estimate(second, true).checkpoint_disk;
  EXPECT_GT(expected, 1e7);
  EXPECT_NEAR(disk_of_sweep(60.0) - disk_of_sweep(0.0), expected, 1.0);
}

}  // namespace
}  // namespace gem
