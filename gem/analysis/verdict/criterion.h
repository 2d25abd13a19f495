// What all criteria share: a measured value, two bounds, and the line of text that says so.
#pragma once

#include <string>

#include "gem/analysis/verdict/run_measures.h"
#include "gem/base/number_text.h"
#include "gem/record/verdict.h"

namespace gem {

/// A criterion apart from the value. Texts are for people.
struct Criterion {
  std::string name;              // one word, as in run files
  double doubtful_above;         // infinity: never
  double bad_above;              // infinity: never
  std::string (*shown)(double);  // a value or bound with its unit
  std::string advice;            // what to do if the run is not good
  std::string not_measured;      // why there may be no value
};

/// A share in percent.
inline std::string percent_text(double share) { return number_text(100.0 * share, 3) + " %"; }

/// A ratio without unit.
inline std::string ratio_text(double ratio) { return number_text(ratio, 3); }

/// A value equal to a bound has the better grade. NaN is not judged.
Grade grade_of(double value, double doubtful_above, double bad_above);

/// Judges `measured`; `finding` is the beginning of the text, with the value in words.
Judgement judge(const Criterion& criterion, Occurred measured, const std::string& finding);

}  // namespace gem
