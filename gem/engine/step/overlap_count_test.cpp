// Overlap histogram: classes without gaps, and quantiles at upper class edges.
#include "gem/engine/step/overlap_count.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

TEST(OverlapCount, EveryClassEndsWhereTheNextBegins) {
  for (int i = 0; i + 1 < OverlapCount::classes; ++i) {
    const double edge = OverlapCount::upper_edge(i);
    EXPECT_EQ(OverlapCount::class_of(std::nextafter(edge, 0.0)), i);
    EXPECT_EQ(OverlapCount::class_of(edge), i + 1);
    // eight classes per octave: an edge is at most an eighth above the value
    EXPECT_LE(OverlapCount::upper_edge(i + 1) / edge, 1.125);
  }
}

TEST(OverlapCount, EndsTakeWhatLiesBeyond) {
  EXPECT_EQ(OverlapCount::class_of(0.0), 0);
  EXPECT_EQ(OverlapCount::class_of(1e-300), 0);
  EXPECT_EQ(OverlapCount::class_of(0x1p-40), 0);
  EXPECT_EQ(OverlapCount::class_of(1e300), OverlapCount::classes - 1);
  EXPECT_EQ(OverlapCount::upper_edge(OverlapCount::classes - 1), 256.0);
}

TEST(OverlapCount, QuantileIsTheEdgeBelowWhichTheShareLies) {
  OverlapCount counts;
  EXPECT_EQ(counts.quantile(0.999), 0.0);
  for (int i = 0; i < 999; ++i) counts.add(1e-3);
  counts.add(0.5);
  EXPECT_EQ(counts.total(), 1000);
  EXPECT_GT(counts.quantile(0.999), 1e-3);
  EXPECT_LE(counts.quantile(0.999), 1.125e-3);
  EXPECT_EQ(counts.quantile(1.0), 0.5625);
  counts.add(0.5);  // two of 1001 values are more than a thousandth
  EXPECT_EQ(counts.quantile(0.999), 0.5625);
}

TEST(OverlapCount, SumsClassByClass) {
  OverlapCount a, b;
  a.add(0.25);
  b.add(0.25);
  b.add(4.0);
  a += b;
  EXPECT_EQ(a.total(), 3);
  EXPECT_EQ(a.count[OverlapCount::class_of(0.25)], 2);
  EXPECT_EQ(a.count[OverlapCount::class_of(4.0)], 1);
}

}  // namespace
}  // namespace gem
