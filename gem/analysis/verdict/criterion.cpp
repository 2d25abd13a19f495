// Grades and texts.
#include "gem/analysis/verdict/criterion.h"

#include <cmath>

namespace gem {
namespace {

std::string bounds_text(const Criterion& criterion) {
  std::string text = "doubtful above " + criterion.shown(criterion.doubtful_above);
  if (std::isfinite(criterion.bad_above)) text += ", bad above " + criterion.shown(criterion.bad_above);
  return text;
}

}  // namespace

Grade grade_of(double value, double doubtful_above, double bad_above) {
  if (std::isnan(value)) return Grade::not_judged;
  return value > bad_above ? Grade::bad : value > doubtful_above ? Grade::doubtful : Grade::good;
}

Judgement judge(const Criterion& criterion, Occurred measured, const std::string& finding) {
  Judgement judgement;
  judgement.criterion = criterion.name;
  judgement.grade = grade_of(measured.value, criterion.doubtful_above, criterion.bad_above);
  judgement.value = measured.value;
  judgement.doubtful_above = criterion.doubtful_above;
  judgement.bad_above = criterion.bad_above;
  judgement.time_s = measured.time_s;
  if (judgement.grade == Grade::not_judged) {
    judgement.text = criterion.not_measured;
    return judgement;
  }
  judgement.text = finding;
  if (!std::isnan(measured.time_s)) judgement.text += " at " + number_text(measured.time_s, 6) + " s";
  judgement.text += " (" + bounds_text(criterion) + ")";
  if (judgement.grade != Grade::good) judgement.text += "; " + criterion.advice;
  return judgement;
}

}  // namespace gem
