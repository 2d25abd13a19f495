// The verdict on a run: how far its numbers can be believed, by criterion.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace gem {

/// Ordered: the larger the worse. `not_judged`: nothing was measured.
enum class Grade { not_judged, good, doubtful, bad };

/// The grade as a run file and the program say it.
constexpr const char* grade_name(Grade grade) {
  constexpr const char* names[] = {"not judged", "good", "doubtful", "bad"};
  return names[static_cast<int>(grade)];
}

/// What one criterion says of a run.
struct Judgement {
  std::string criterion;  // its name, without blanks
  Grade grade = Grade::not_judged;
  double value = std::nan("");                                      // NaN: not measured
  double doubtful_above = std::numeric_limits<double>::infinity();  // infinity: never
  double bad_above = std::numeric_limits<double>::infinity();
  double time_s = std::nan("");  // simulated time of the value; NaN: a value of the whole run
  std::string text;              // one line: the number, its bounds, its time, what to do; or why it was not judged
};

/// The worst grade of all criteria, and what each says.
struct RunVerdict {
  Grade grade = Grade::not_judged;
  std::vector<Judgement> judgements;
};

}  // namespace gem
