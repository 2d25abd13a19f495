// Kinds of islands and their tolerances.
#include "gem/engine/solver/splitting/island_size.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

TEST(IslandSize, TellsAChainFromAPlugByItsContacts) {
  const IslandSize row{100, 200, 100}, branched{100, 150, 106};  // a row at a wall, face on face
  EXPECT_TRUE(row.is_chain());
  EXPECT_TRUE(branched.is_chain());
  const IslandSize plug{100, 160, 107}, jam{100, 270, 200};
  for (const IslandSize& one : {plug, jam}) {
    EXPECT_TRUE(one.is_jam());
    EXPECT_FALSE(one.is_chain());
  }
  for (const IslandSize& one : {IslandSize{15, 15, 15}, IslandSize{15, 60, 40}}) {
    EXPECT_TRUE(one.is_small());
    EXPECT_FALSE(one.is_chain() || one.is_jam());
  }
  EXPECT_FALSE((IslandSize{15, 33, 20}.may_lock()));
  EXPECT_TRUE((IslandSize{15, 34, 20}.may_lock()));
  EXPECT_FALSE((IslandSize{16, 60, 40}.may_lock())) << "not small";
}

TEST(IslandSize, LetsOnlyAJamUseTheWholeTolerance) {
  EXPECT_EQ((IslandSize{100, 270, 200}.tolerance(1e-3)), 1e-3);
  EXPECT_EQ((IslandSize{100, 200, 100}.tolerance(1e-3)), 1e-3 / 32.0);
  EXPECT_EQ((IslandSize{2, 2, 1}.tolerance(1e-3)), 1e-3 / 32.0);
  EXPECT_EQ((IslandSize{128, 256, 128}.tolerance(1e-3)), 1e-3 / 32.0);
  EXPECT_EQ((IslandSize{256, 512, 256}.tolerance(1e-3)), 1e-3 / 16.0);
  EXPECT_EQ((IslandSize{1000, 2000, 1000}.tolerance(1e-3)), 1e-3 / 8.0);
}

}  // namespace
}  // namespace gem
