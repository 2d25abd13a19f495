// Shares of a GPU among scenes.
#include "gem/engine/device/block_share.h"

#include <gtest/gtest.h>

#include <numeric>

namespace gem {
namespace {

// 132 multiprocessors in groups of 14 to 18
constexpr ClusterPlaces device = {132, 66, 32, 16, 7};

int sum(const std::vector<int>& blocks) { return std::accumulate(blocks.begin(), blocks.end(), 0); }

std::vector<int> shares(const std::vector<double>& work, int equal) {
  return share_blocks(work, std::vector<int>(work.size(), 100), device, equal);
}

TEST(BlockShare, ScenesThatFillTheDeviceEvenlyHaveAsManyEach) {
  EXPECT_EQ(shares(std::vector<double>(16, 1.0), 8), std::vector<int>(16, 8));
  EXPECT_EQ(shares(std::vector<double>(66, 1.0), 2), std::vector<int>(66, 2));
  EXPECT_EQ(shares(std::vector<double>(132, 1.0), 1), std::vector<int>(132, 1));
}

TEST(BlockShare, NoMultiprocessorIsLeftOver) {
  for (const std::size_t scenes : {12, 20, 33, 36, 50, 100}) {
    const int blocks = sum(shares(std::vector<double>(scenes, 1.0), 1));
    EXPECT_GT(blocks, 126) << scenes;
    EXPECT_LE(blocks, 132) << scenes;
  }
}

TEST(BlockShare, HeavyScenesGetMoreAndAllFit) {
  std::vector<double> work(36, 2.0);
  for (std::size_t k = 0; k < 12; ++k) work[3 * k] = 14.0;
  const std::vector<int> blocks = shares(work, 3);
  EXPECT_GT(sum(blocks), 126);
  EXPECT_LE(sum(blocks), 132);
  ClusterPlaces clusters{};
  for (std::size_t k = 0; k < 36; ++k) {
    EXPECT_TRUE(k % 3 == 0 ? blocks[k] == 8 : blocks[k] <= 2) << k;
    for (std::size_t size = 0; size < share_sizes.size(); ++size) clusters[size] += blocks[k] == share_sizes[size];
  }
  EXPECT_TRUE(fit_together(clusters, device));
}

TEST(BlockShare, ClustersThatDoNotFitAreSeen) {
  EXPECT_TRUE(fit_together({4, 0, 0, 16, 0}, device));
  EXPECT_FALSE(fit_together({0, 0, 1, 16, 0}, device));  // 132 blocks, but no group has four left over
  EXPECT_FALSE(fit_together({5, 0, 0, 16, 0}, device));
}

TEST(BlockShare, APlatformAloneHasOneBlock) {
  EXPECT_EQ(useful_blocks(1), 1);
  EXPECT_EQ(useful_blocks(47), 1);
  EXPECT_EQ(useful_blocks(4009), 167);
  EXPECT_EQ(share_blocks({1.0, 1.0, 1.0}, {1, 100, 3}, device, 8), (std::vector<int>{1, 16, 2}));
}

TEST(BlockShare, TooManyScenesHaveAsManyEach) {
  EXPECT_EQ(shares(std::vector<double>(264, 1.0), 1), std::vector<int>(264, 1));
}

TEST(StepShare, SlowScenesMakeFewerTimeStepsInTheSameTime) {
  EXPECT_EQ(share_steps({1.0, 1.0}, 16, 256), (std::vector<std::int64_t>{256, 256}));
  EXPECT_EQ(share_steps({1.0, 2.0, 4.0}, 16, 256), (std::vector<std::int64_t>{256, 128, 64}));
  EXPECT_EQ(share_steps({1.0, 100.0}, 16, 256), (std::vector<std::int64_t>{256, 16}));
}

}  // namespace
}  // namespace gem
