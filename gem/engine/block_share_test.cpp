// Shares of a GPU among scenes.
#include "gem/engine/block_share.h"

#include <gtest/gtest.h>

#include <numeric>

namespace gem {
namespace {

int sum(const std::vector<int>& blocks) { return std::accumulate(blocks.begin(), blocks.end(), 0); }

TEST(BlockShare, EqualScenesGetEqualSharesAsFarAsTheyGo) {
  EXPECT_EQ(share_blocks(std::vector<double>(12, 1.0), 132, 8), std::vector<int>(12, 8));
  for (const int blocks : share_blocks(std::vector<double>(36, 1.0), 132, 3)) EXPECT_GE(blocks, 3);
}

TEST(BlockShare, HeavyScenesGetMoreAndAllFit) {
  std::vector<double> work(36, 2.0);
  for (std::size_t k = 0; k < 12; ++k) work[3 * k] = 8.0;
  const std::vector<int> blocks = share_blocks(work, 132, 3);
  EXPECT_LE(sum(blocks), 132);
  for (std::size_t k = 0; k < 36; ++k) EXPECT_TRUE(k % 3 == 0 ? blocks[k] >= 4 : blocks[k] == 2) << k;
}

TEST(BlockShare, APlatformAloneHasOneBlock) {
  EXPECT_EQ(useful_blocks(1), 1);
  EXPECT_EQ(useful_blocks(47), 1);
  EXPECT_EQ(useful_blocks(4009), 167);
}

TEST(BlockShare, TooManyScenesHaveAsManyEach) {
  EXPECT_EQ(share_blocks(std::vector<double>(66, 1.0), 132, 2), std::vector<int>(66, 2));
}

}  // namespace
}  // namespace gem
