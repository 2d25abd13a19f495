// The list of criteria, in the order in which they are shown.
#include "gem/analysis/verdict/judge_run.h"

#include <algorithm>

#include "gem/analysis/verdict/energy_criterion.h"
#include "gem/analysis/verdict/nyquist_criterion.h"
#include "gem/analysis/verdict/overlap_criterion.h"
#include "gem/analysis/verdict/residual_criterion.h"
#include "gem/analysis/verdict/softened_criterion.h"
#include "gem/analysis/verdict/speed_criterion.h"
#include "gem/analysis/verdict/unfinished_criterion.h"

namespace gem {
namespace {

void add(RunVerdict& verdict, Judgement judgement) {
  verdict.grade = std::max(verdict.grade, judgement.grade);
  verdict.judgements.push_back(std::move(judgement));
}

}  // namespace

RunVerdict judge_run(const RunMeasures& run) {
  RunVerdict verdict;
  add(verdict, judge_overlap(run));
  if (run.compliant) {
    add(verdict, judge_softened(run));
  } else {
    add(verdict, judge_unfinished(run));
    add(verdict, judge_residual(run));
  }
  for (const auto criterion : {judge_speed, judge_energy, judge_nyquist}) add(verdict, criterion(run));
  return verdict;
}

RunVerdict judge_stopped_run(const RunMeasures& run, const std::string& why) {
  RunVerdict verdict = judge_run(run);
  Judgement stop;
  stop.criterion = "stopped";
  stop.grade = Grade::bad;
  stop.text = why;
  add(verdict, std::move(stop));
  return verdict;
}

}  // namespace gem
