// A verdict in few words.
#include "gem/analysis/verdict/verdict_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace gem {
namespace {

RunVerdict verdict_with(Grade overlap, Grade unfinished) {
  RunVerdict verdict{std::max(overlap, unfinished), {}};
  for (const auto& [name, grade] : {std::pair{"overlap", overlap}, std::pair{"unfinished_steps", unfinished}}) {
    verdict.judgements.emplace_back();
    verdict.judgements.back().criterion = name;
    verdict.judgements.back().grade = grade;
  }
  return verdict;
}

TEST(VerdictWords, NameTheCriteriaOfTheWorstGrade) {
  EXPECT_EQ(verdict_text(verdict_with(Grade::good, Grade::good)), "good");
  EXPECT_EQ(verdict_text(verdict_with(Grade::doubtful, Grade::doubtful)), "doubtful: overlap, unfinished_steps");
  EXPECT_EQ(verdict_text(verdict_with(Grade::bad, Grade::doubtful)), "bad: overlap");
  EXPECT_EQ(verdict_text(verdict_with(Grade::not_judged, Grade::not_judged)), "not judged");
  EXPECT_EQ(verdict_text({Grade::bad, {}}), "bad") << "a file without criteria";
}

TEST(VerdictWords, UnfinishedStepsCastDoubtOnShortLoads) {
  EXPECT_EQ(doubt_text(verdict_with(Grade::bad, Grade::doubtful)), " (not converged)");
  EXPECT_EQ(doubt_text(verdict_with(Grade::doubtful, Grade::good)), "");
}

}  // namespace
}  // namespace gem
