// Sums without a fixed order: the order matters in single precision, a repeat is reproducible, and one time step equals
// the ordered one except for rounding.
#include "validation/paper/experiments/unordered_engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <tuple>

#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem::repeats {

/// Names a parameterised test by the start of its sums.
inline void PrintTo(SumStart start, std::ostream* out) {
  *out << (start == SumStart::zero ? "from_zero" : "from_velocity");
}

namespace {

constexpr double kUnit = 0x1p-24;  // half a unit in the last place of 1 in single precision

class UnorderedSums : public testing::TestWithParam<std::tuple<ContactSolver, SumStart>> {
 protected:
  SceneDef scene() const {
    SceneDef scene = test::busy_scene(3);
    scene.contact.solver = std::get<0>(GetParam());
    return scene;
  }
  UnorderedEngine repeat(std::uint64_t seed) const {
    const SceneDef made = scene();
    return {made, test::busy_field(made), std::get<1>(GetParam()), seed};
  }
};

TEST(SumOfPushes, DependsOnItsOrderInSinglePrecision) {
  constexpr auto e = static_cast<float>(kUnit);
  const SingleMotion one{1.0F, 0.0F, 1.0F}, hair{e, 0.0F, e};
  EXPECT_EQ(sum_of({}, {one, hair, hair}).x, 1.0F);
  EXPECT_EQ(sum_of({}, {hair, hair, one}).x, 1.0F + 2.0F * e);
  EXPECT_EQ(sum_of({}, {one, hair}).spin, sum_of({}, {hair, one}).spin);  // two terms have no order
  EXPECT_EQ(sum_of(one, {hair, hair}).x, 1.0F);
}

TEST(SumOfPushes, EveryOrderComesAsOften) {
  RandomSequence random(Random(1, 2));
  std::map<std::tuple<float, float, float>, int> seen;
  constexpr int draws = 6000;
  for (int i = 0; i < draws; ++i) {
    std::vector<SingleMotion> pushes = {{1.0F}, {2.0F}, {3.0F}};
    shuffle(pushes, random);
    ++seen[{pushes[0].x, pushes[1].x, pushes[2].x}];
  }
  ASSERT_EQ(seen.size(), 6U);
  // Five standard deviations of a binomial count of mean 1000.
  for (const auto& [order, count] : seen) EXPECT_NEAR(count, draws / 6, 145);
}

TEST_P(UnorderedSums, TheSameRepeatHasTheSameBits) {
  UnorderedEngine first = repeat(1), again = repeat(1);
  StepLog first_log, again_log;
  first.advance(300, first_log);
  again.advance(300, again_log);
  ASSERT_GT(first.statistics().changed, 0);
  EXPECT_EQ(first.state_hash(), again.state_hash());
  test::expect_same_log(first_log, again_log);
}

TEST_P(UnorderedSums, TwoRepeatsPartOnceOrderMatters) {
  UnorderedEngine first = repeat(1), second = repeat(2);
  StepLog log;
  while (first.statistics().changed == 0 && first.step() < 300) {
    ASSERT_EQ(first.state_hash(), second.state_hash()) << "time step " << first.step();
    first.advance(1, log);
    second.advance(1, log);
    if (second.statistics().changed > 0) break;
  }
  first.advance(300 - first.step(), log);
  second.advance(300 - second.step(), log);
  EXPECT_NE(first.state_hash(), second.state_hash());
}

TEST_P(UnorderedSums, ATimeStepIsTheOrderedOneButForRounding) {
  const SceneDef made = scene();
  CpuEngine ordered(made, test::busy_field(made), 1, EngineOptions{}.contacts_worth_a_thread);
  StepLog log;
  ordered.advance(50, log);
  UnorderedEngine unordered = repeat(1);
  double largest = 0.0;
  for (int step = 0; step < 20; ++step) {
    unordered.restore(ordered.save());
    ordered.advance(1, log);
    unordered.advance(1, log);
    const Bodies &a = ordered.bodies(), &b = unordered.bodies();
    for (std::size_t i = 0; i < a.count(); ++i) largest = std::max(largest, length(a.velocity[i] - b.velocity[i]));
  }
  const SumStatistics& s = unordered.statistics();
  ASSERT_GT(s.several, 0);
  // Each of n terms is rounded, and each of n additions has an error of half a unit of at most the whole: (n + 1) units
  // in each of two components. A body here has at most twelve neighbours with two points each, and its velocity.
  constexpr double terms = 25.0;
  EXPECT_LE(s.rounding_largest, 2.0 * terms * kUnit);
  EXPECT_LE(s.order_largest, 4.0 * terms * kUnit);
  EXPECT_GT(largest, 0.0);
  // The pushes on a floe add up to at most 10 m/s here; no speed exceeds 3 m/s.
  EXPECT_LT(largest, 2.0 * terms * kUnit * 10.0);
}

INSTANTIATE_TEST_SUITE_P(Sums, UnorderedSums,
                         testing::Combine(testing::Values(ContactSolver::independent, ContactSolver::coupled),
                                          testing::Values(SumStart::zero, SumStart::velocity)),
                         test::LawNames());

}  // namespace
}  // namespace gem::repeats
