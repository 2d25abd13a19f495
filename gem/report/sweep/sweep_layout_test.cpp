// The matrix of a sweep follows from the names of its runs.
#include "gem/report/sweep/sweep_layout.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

using Names = std::vector<std::string>;

TEST(SweepLayout, TheLastTwoPartsAreTheColumn) {
  const SweepLayout layout = sweep_layout({"004_400_25", "004_400_50", "004_300_25", "040_400_25", "040_300_25"});
  EXPECT_EQ(layout.rows, (Names{"004", "040"}));
  EXPECT_EQ(layout.columns, (Names{"400_25", "400_50", "300_25"}));
  EXPECT_EQ(layout.cell[1][2], std::optional<std::size_t>(4));
  EXPECT_EQ(layout.cell[1][1], std::nullopt) << "the sweep has no 040_400_50";
}

TEST(SweepLayout, TheLastPartIfTwoAreTooWide) {
  Names names;
  for (const char* gap : {"1", "2", "3"})
    for (const char* speed : {"1", "2", "3", "4"}) names.push_back(std::string("ice_") + gap + "_" + speed);
  const SweepLayout layout = sweep_layout(names);
  EXPECT_EQ(layout.rows, (Names{"ice_1", "ice_2", "ice_3"}));
  EXPECT_EQ(layout.columns.size(), 4u);
  EXPECT_EQ(layout.cell[2][3], std::optional<std::size_t>(11));
}

TEST(SweepLayout, OneRowPerRunWithoutSuchNames) {
  for (const Names& names : {Names{"a", "b_1"}, Names{"a_1", "b_1"}, Names{"_1", "_2"}, Names{"one"}}) {
    const SweepLayout layout = sweep_layout(names);
    EXPECT_EQ(layout.rows, names);
    EXPECT_EQ(layout.columns.size(), 1u);
    EXPECT_EQ(layout.cell.back()[0], std::optional<std::size_t>(names.size() - 1));
  }
}

}  // namespace
}  // namespace gem
