// The numbers of an iteration's course, and where it takes them from.
#include "gem/engine/solver/iteration_course.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace gem {
namespace {

TEST(CarriedAhead, IsNesterovsSequenceFromAFairStartAndFromNothing) {
  constexpr std::int64_t most = 40;
  const std::vector<float> ahead = carried_ahead(most);
  ASSERT_EQ(ahead.size(), 2u * most);
  EXPECT_EQ(ahead[most], 0.0F) << "from nothing the first iteration carries nothing ahead";
  // theta' = (1 + sqrt(1 + 4 theta^2)) / 2, so theta'^2 - theta' = theta^2
  for (const auto& [first, theta] : {std::pair<std::int64_t, double>{0, 4.0}, {most, 1.0}}) {
    double now = theta;
    for (std::int64_t k = 0; k < most; ++k) {
      const double next = (now - 1.0) / static_cast<double>(ahead[static_cast<std::size_t>(first + k)]);
      const bool divides = k > 0 || first == 0;  // not by the nothing that stands first
      EXPECT_TRUE(!divides || std::abs(next * next - next - now * now) < 1e-4 * now * now) << "iteration " << k;
      now = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * now * now));
    }
  }
}

TEST(IterationCourse, BeginsFromNothingWhenTheResidualHasGrown) {
  constexpr std::int64_t most = 12;
  const std::vector<float> ahead = carried_ahead(most);
  IterationCourse course(1e-3, most, false, ahead.data());
  EXPECT_EQ(course.ahead(), ahead[0]);
  EXPECT_EQ(course.after(1.0F), IterationCourse::Next::iteration);
  EXPECT_EQ(course.ahead(), ahead[1]);
  EXPECT_EQ(course.after(2.5F), IterationCourse::Next::iteration);
  EXPECT_EQ(course.ahead(), ahead[most]) << "more than twice the lowest";
}

TEST(IterationCourse, EndsAtItsResidualWhereItLooksAndAtItsMost) {
  const std::vector<float> ahead = carried_ahead(5);
  IterationCourse met(0.5, 5, false, ahead.data());
  met.ahead();
  EXPECT_EQ(met.after(0.25F), IterationCourse::Next::end);
  IterationCourse slow(0.5, 5, false, ahead.data());
  for (int k = 0; k < 5; ++k) {
    slow.ahead();
    EXPECT_EQ(slow.after(1.0F), k < 4 ? IterationCourse::Next::iteration : IterationCourse::Next::end);
  }
  EXPECT_EQ(slow.iteration(), 5);
}

}  // namespace
}  // namespace gem
