// Words for grades and criteria.
#include "gem/analysis/verdict/verdict_words.h"

#include <algorithm>

namespace gem {

bool stops_short(const RunVerdict& verdict) {
  return std::any_of(verdict.judgements.begin(), verdict.judgements.end(), [](const Judgement& one) {
    return one.criterion == "unfinished_steps" && one.grade == Grade::doubtful;
  });
}

std::string doubt_text(const RunVerdict& verdict) { return stops_short(verdict) ? " (not converged)" : ""; }

std::string criteria_of_grade(const RunVerdict& verdict, Grade grade) {
  std::string names;
  for (const Judgement& one : verdict.judgements)
    if (one.grade == grade) names += (names.empty() ? "" : ", ") + one.criterion;
  return names;
}

std::string doubts_of(const RunVerdict& verdict) {
  const bool doubted = verdict.grade == Grade::doubtful || verdict.grade == Grade::bad;
  return doubted ? criteria_of_grade(verdict, verdict.grade) : "";
}

std::string verdict_text(const RunVerdict& verdict) {
  const std::string doubts = doubts_of(verdict);
  return grade_name(verdict.grade) + (doubts.empty() ? "" : ": " + doubts);
}

}  // namespace gem
