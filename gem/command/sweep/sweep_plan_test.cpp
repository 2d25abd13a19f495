// How runs are divided into batches.
#include "gem/command/sweep/sweep_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace gem
