// Tests of the shares of a GPU among scenes.
#include "gem/engine/device/block_share.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

constexpr int device_blocks = 132;  // blocks that the device runs at a time

int sum(const std::vector<int>& blocks) { return std::accumulate(blocks.begin(), blocks.end(), 0); }

TEST(BlockShare, OneSceneHasAllThatAreUseful) {
  EXPECT_EQ(share_blocks({3.0}, {167}, device_blocks), std::vector<int>{132});
  EXPECT_EQ(share_blocks({3.0}, {40}, device_blocks), std::vector<int>{40});
}

TEST(BlockShare, EqualScenesFillTheDevice) {
  for (const std::size_t scenes : {2, 7, 12, 33, 36, 66, 100, 132}) {
    const std::vector<int> blocks =
        share_blocks(std::vector<double>(scenes, 1.0), std::vector<int>(scenes, 167), device_blocks);
    EXPECT_EQ(sum(blocks), device_blocks) << scenes;
    const auto [least, most] = std::minmax_element(blocks.begin(), blocks.end());
    EXPECT_LE(*most - *least, 1) << scenes;
  }
}

TEST(BlockShare, HeavyScenesGetMoreAndAllFit) {
  const std::vector<int> blocks = share_blocks({6.0, 1.0, 2.0}, {167, 167, 167}, device_blocks);
  EXPECT_EQ(blocks, (std::vector<int>{87, 16, 29}));
  EXPECT_EQ(sum(blocks), device_blocks);
}

TEST(BlockShare, WhatASceneHasNoUseForGoesToTheOthers) {
  EXPECT_EQ(share_blocks({1.0, 1.0, 1.0}, {1, 100, 3}, device_blocks), (std::vector<int>{1, 100, 3}));
  EXPECT_EQ(share_blocks({1.0, 1.0, 1.0}, {100, 100, 3}, device_blocks), (std::vector<int>{64, 65, 3}));
}

TEST(BlockShare, ScenesWithoutWorkHaveABlockEach) {
  EXPECT_EQ(share_blocks({0.0, 0.0}, {5, 5}, device_blocks), (std::vector<int>{1, 1}));
}

TEST(BlockShare, MoreScenesThanBlocksHaveOneEach) {
  EXPECT_EQ(share_blocks(std::vector<double>(264, 1.0), std::vector<int>(264, 100), device_blocks),
            std::vector<int>(264, 1));
}

TEST(BlockShare, APlatformAloneHasOneBlock) {
  EXPECT_EQ(useful_blocks(1), 1);
  EXPECT_EQ(useful_blocks(47), 1);
  EXPECT_EQ(useful_blocks(4009), 167);
}

using Steps = std::vector<std::int64_t>;

TEST(StepShare, ScenesThatHaveMoreAheadMakeMore) {
  EXPECT_EQ(share_steps({1000, 1000}, {1000, 1000}, 256), (Steps{256, 256}));
  EXPECT_EQ(share_steps({1000, 500, 1}, {1000, 500, 1}, 256), (Steps{256, 128, 1}));
}

TEST(StepShare, NoneMakesMoreThanItMay) {
  EXPECT_EQ(share_steps({1000, 1000, 1000}, {1000, 3, 0}, 256), (Steps{256, 3, 0}));
  EXPECT_EQ(share_steps({10, 10}, {10, 10}, 256), (Steps{10, 10}));
}

}  // namespace
}  // namespace gem
