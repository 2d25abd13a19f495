// The section on repeats with sums without a fixed order.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "gem/report/display.h"
#include "validation/paper/page/page_parts.h"

namespace gem {
namespace {

constexpr double kPaperParting = 3300.0;  // "almost an hour" [s]

std::string differs_text(const UnorderedPairs& pairs) {
  const std::string sums = pairs.sums == "zero"       ? "sums from zero"
                           : pairs.sums == "velocity" ? "added to the velocity"
                                                      : "one floe " + pairs.sums + " m";
  if (pairs.repeats) return sums + ", repeat against repeat";
  return pairs.sums == "zero" ? sums + ", against order and double precision" : sums;
}

/// Times at which the distances reach a level: median, first and last, and how many do.
std::string reach_text(const UnorderedPairs& pairs, double interval_s, double level_m) {
  std::vector<double> times;
  for (const std::vector<double>& distance : pairs.distances)
    if (const auto time = onset_time(distance, interval_s, level_m)) times.push_back(*time);
  if (times.empty()) return "never";
  std::sort(times.begin(), times.end());
  const std::size_t n = times.size();
  const double middle = 0.5 * (times[(n - 1) / 2] + times[n / 2]);
  std::string text =
      rounded_text(middle, 3) + " (" + rounded_text(times.front(), 3) + " … " + rounded_text(times.back(), 3) + ")";
  if (n < pairs.distances.size()) text += ", " + std::to_string(n) + " of them";
  return text;
}

/// For repeats: the constant rate at which the distance would grow from its start to half the deviation at time
/// kPaperParting [1/s].
std::string asked_text(const UnorderedPairs& pairs, double interval_s) {
  if (!pairs.repeats) return "";
  double sum = 0.0, count = 0.0;
  for (const std::vector<double>& distance : pairs.distances) {
    const auto first = std::find_if(distance.begin(), distance.end(), [](double d) { return d > 0.0; });
    const double time = interval_s * static_cast<double>(first - distance.begin());
    if (first == distance.end() || time >= kPaperParting) continue;
    sum += std::log(0.5 * pairs.swing_m / *first) / (kPaperParting - time);
    ++count;
  }
  return count > 0.0 ? rounded_text(sum / count, 2) : "-";
}

std::string rates_text(const std::optional<GrowthRate>& growth) {
  if (!growth) return "not resolved | |";
  const auto text = [](const IntervalEstimate& rate) {
    return rounded_text(rate.value, 3) + " (" + end_text(rate.low) + " … " + end_text(rate.high) + ")";
  };
  return text(growth->rate) + " | " + text(growth->early) + " | " + text(growth->late);
}

std::string parting_table(const UnorderedStudy& study) {
  std::ostringstream text;
  text << "| contacts | what differs | pairs | 1 mm [s] | 1 cm [s] | 10 cm [s] | half the deviation [s] | growth rate "
          "[1/s] | early half | late half | rate that would part them at "
       << kPaperParting << " s [1/s] |\n|---|---|---:|---|---|---|---|---|---|---|---:|\n";
  for (const UnorderedPairs& pairs : study.pairs) {
    text << "| " << pairs.contacts << " | " << differs_text(pairs) << " | " << pairs.distances.size();
    for (const double level : {1e-3, 1e-2, 0.1, 0.5 * pairs.swing_m})
      text << " | " << reach_text(pairs, study.interval_s, level);
    text << " | " << rates_text(pairs.growth) << " | " << asked_text(pairs, study.interval_s) << " |\n";
  }
  return text.str() + "\n";
}

std::string sums_table(const UnorderedStudy& study) {
  std::ostringstream text;
  text << "| contacts | sums | repeat | swing of x [mm] | sums taken | order can matter | order changed bits | by "
          "order, "
          "rms (largest) | by rounding, rms (largest) | platform's velocity by order, rms [m/s] | state hash "
          "|\n|---|---|---:|---:|---:|---:|---:|---|---|---:|---|\n";
  for (const UnorderedRun& run : study.runs) {
    if (run.sums.starts_with("moved")) continue;
    text << "| " << run.contacts << " | " << run.sums << " | " << run.run << " | " << rounded_text(1e3 * run.swing_m, 3)
         << " | ";
    if (run.sums == "ordered") {
      text << "| | | | | | ";
    } else {
      text << exponent_text(run.taken) << " | " << exponent_text(run.several) << " | " << exponent_text(run.changed)
           << " | " << exponent_text(run.order_rms) << " (" << exponent_text(run.order_largest) << ") | "
           << exponent_text(run.rounding_rms) << " (" << exponent_text(run.rounding_largest) << ") | "
           << exponent_text(run.platform_rms) << " | ";
    }
    text << "`" << run.state_hash << "` |\n";
  }
  return text.str() + "\n";
}

}  // namespace

std::string unordered_text(const UnorderedStudy& study) {
  std::string text = "## What sums in no fixed order do\n\n";
  if (study.runs.empty()) return text + "Needs the rows of `build/unordered_sums`.\n\n";
  text +=
      "Run 1 repeated with a variant of the `cpu` engine in which what the contacts push a body is added up in single "
      "precision in an order drawn anew for every body and moment, as by atomic additions; laws, stages and all else "
      "are the engine's, in double precision. *From zero*: the sum is taken first (of two pushes the order is "
      "nothing). "
      "*Added to the velocity*: which is held in single precision while they come. With `coupled` contacts the "
      "iterations are the engine's, and the impulses that they end with are summed so. Friction of ice 0.1; "
      "`independent` with chords of the middle. Distance as above: the amplitude at which the difference of two "
      "platforms swings, so that |dx| comes up to it within half a period. Times from the start: the middle pair, the "
      "first and the last. Half the deviation is that of x of the run in order. Growth from ten times where it begins "
      "to a tenth of the deviation, interval over the pairs; against order and double precision all repeats begin with "
      "nearly the same rounding, so that theirs tells little. The paper's record parts after almost an hour: the last "
      "column is the steady rate that would take repeats as long. Made by commit `" +
      study.runs.front().commit + "`.\n\n";
  return text + parting_table(study) +
         "How large the differences of one moment are. A sum's difference is relative to the lengths of all that was "
         "added; it is larger where all of it is below 1e-38 m/s, which single precision keeps with fewer digits.\n\n" +
         sums_table(study);
}

}  // namespace gem
