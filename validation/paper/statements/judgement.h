// The rules by which a statement of the paper is judged: a measured number with its interval against an expectation.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gem {

/// A number and the interval that the verdict is about. What the interval is, is said in words.
struct Measured {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::string interval;           // "95 % over 5 runs", "smallest to largest of 3 runs", ...
  std::vector<double> each = {};  // the number of every run where it is made of such
};

enum class RuleKind {
  within,      // the interval lies within expected +- tolerance
  above,       // the interval lies above expected
  below,       // the interval lies below expected
  significant  // a chance below expected; a larger one proves nothing
};

struct Rule {
  RuleKind kind = RuleKind::within;
  double expected = 0.0;
  double tolerance = 0.0;  // of `within`
};

enum class Verdict { reproduced, not_reproduced, undecidable };

/// Reproduced if the whole interval obeys the rule, not reproduced if none of it does, undecidable between these, for
/// numbers that are not finite, and without a measurement.
Verdict judge(const Rule& rule, const std::optional<Measured>& measured);

/// Fewer runs than this say nothing about most runs: even if all of them obey, their interval holds one half.
inline constexpr std::size_t kRunsForShare = 4;

/// How many runs obey a rule for themselves, with the interval of the share by Wilson's score.
struct HeldShare {
  std::size_t holds = 0;
  std::size_t runs = 0;
  double low = 0.0;
  double high = 0.0;
};
/// Empty for fewer than kRunsForShare runs.
std::optional<HeldShare> held_share(const Rule& rule, const std::vector<double>& each);

/// A statement about each run holds if more than the share `least` of all runs would obey it: reproduced if the
/// interval of the share lies above, not reproduced if it lies below, undecidable otherwise.
Verdict judge_share(const HeldShare& share, double least);

std::string verdict_text(Verdict verdict);
/// "72 +- 3.6", "> 1", "< 0.5", "p < 0.05".
std::string rule_text(const Rule& rule);
/// The kind of a name in a file of statements; empty for another word.
std::optional<RuleKind> rule_kind(const std::string& name);

/// How the numbers of several runs become one.
enum class Over {
  mean,    // mean with its interval over the runs; for one run the interval that it brings, otherwise none at all
  every,   // the middle one, from the smallest to the largest: the statement is about each run, and the share of runs
           // that obey it decides
  chances  // chances of independent runs, combined
};

/// A number of one run; low and high are equal to value where the run alone gives no interval.
struct RunNumber {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  bool interval = false;
};

/// Empty without runs. Seeds that change nothing are one run. A single draw without an interval leaves low and high
/// infinite under `mean`: one run decides nothing about an average.
std::optional<Measured> over_runs(const std::vector<RunNumber>& runs, Over over);

}  // namespace gem
