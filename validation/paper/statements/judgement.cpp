// Judges an interval by a rule, and combines the numbers of several runs.
#include "validation/paper/statements/judgement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/equivalence.h"
#include "gem/analysis/statistics/proportion.h"
#include "gem/base/number_text.h"

namespace gem {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Verdict of(bool all, bool none) {
  if (all) return Verdict::reproduced;
  return none ? Verdict::not_reproduced : Verdict::undecidable;
}

std::string runs_text(std::size_t count) { return std::to_string(count) + (count == 1 ? " run" : " runs"); }

Measured mean_over(const std::vector<RunNumber>& runs, const std::vector<double>& values) {
  const bool alike = std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
  if (runs.size() > 1 && !(alike && runs.front().interval)) {
    const IntervalEstimate mean = mean_of_runs(values);
    return {mean.value, mean.low, mean.high, "95 % over " + runs_text(runs.size()), values};
  }
  const RunNumber& only = runs.front();
  if (only.interval) return {only.value, only.low, only.high, "95 % within 1 run", values};
  return {only.value, -kInfinity, kInfinity, "1 run, no interval", values};
}

/// Median of numbers that may be infinite.
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  if (values.size() % 2 == 1 || values[half - 1] == values[half]) return values[half];
  return 0.5 * (values[half - 1] + values[half]);
}

bool obeys(const Rule& rule, double value) {
  switch (rule.kind) {
    case RuleKind::within:
      return std::abs(value - rule.expected) <= rule.tolerance;
    case RuleKind::above:
      return value > rule.expected;
    case RuleKind::below:
    case RuleKind::significant:
      return value < rule.expected;
  }
  return false;
}

}  // namespace

Verdict judge(const Rule& rule, const std::optional<Measured>& measured) {
  if (!measured || std::isnan(measured->value) || std::isnan(measured->low) || std::isnan(measured->high))
    return Verdict::undecidable;
  const double low = measured->low;
  const double high = measured->high;
  switch (rule.kind) {
    case RuleKind::within: {
      const double least = rule.expected - rule.tolerance;
      const double most = rule.expected + rule.tolerance;
      return of(low >= least && high <= most, high < least || low > most);
    }
    case RuleKind::above:
      return of(low > rule.expected, high <= rule.expected);
    case RuleKind::below:
      return of(high < rule.expected, low >= rule.expected);
    case RuleKind::significant:
      return high < rule.expected ? Verdict::reproduced : Verdict::undecidable;
  }
  return Verdict::undecidable;
}

std::optional<HeldShare> held_share(const Rule& rule, const std::vector<double>& each) {
  if (each.size() < kRunsForShare) return std::nullopt;
  HeldShare share;
  share.runs = each.size();
  for (const double value : each) share.holds += obeys(rule, value) ? 1U : 0U;
  const IntervalEstimate interval = wilson_share(share.holds, share.runs);
  share.low = interval.low;
  share.high = interval.high;
  return share;
}

Verdict judge_share(const HeldShare& share, double least) { return of(share.low > least, share.high < least); }

std::string verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::not_reproduced:
      return "not reproduced";
    case Verdict::undecidable:
      return "undecidable";
  }
  return "";
}

std::string rule_text(const Rule& rule) {
  const std::string expected = number_text(rule.expected, 8);
  switch (rule.kind) {
    case RuleKind::within:
      return expected + " ± " + number_text(rule.tolerance, 3);
    case RuleKind::above:
      return "> " + expected;
    case RuleKind::below:
      return "< " + expected;
    case RuleKind::significant:
      return "p < " + expected;
  }
  return "";
}

std::optional<RuleKind> rule_kind(const std::string& name) {
  if (name == "within") return RuleKind::within;
  if (name == "above") return RuleKind::above;
  if (name == "below") return RuleKind::below;
  if (name == "significant") return RuleKind::significant;
  return std::nullopt;
}

std::optional<Measured> over_runs(const std::vector<RunNumber>& runs, Over over) {
  if (runs.empty()) return std::nullopt;
  std::vector<double> values;
  for (const RunNumber& run : runs) values.push_back(run.value);
  if (over == Over::mean) return mean_over(runs, values);
  if (over == Over::chances) {
    const double chance = combined_chance(values);
    return Measured{chance, chance, chance, runs.size() == 1 ? "1 run" : runs_text(runs.size()) + " combined", values};
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return Measured{median(values), *least, *most,
                  runs.size() == 1 ? "1 run" : "smallest to largest of " + runs_text(runs.size()), values};
}

}  // namespace gem
