// The rules that judge a statement of the paper: a measured number with its interval against an expectation.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gem {

/// A number and the interval that is judged; `interval` says in words what the interval is.
struct Measured {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::string interval;           // "95 % over 5 runs", "smallest to largest of 3 runs", ...
  std::vector<double> each = {};  // the number of each run, if there are several
};

enum class RuleKind {
  within,      // the interval lies within expected +- tolerance
  above,       // the interval lies above expected
  below,       // the interval lies below expected
  significant  // a probability below expected; a larger one proves nothing
};

struct Rule {
  RuleKind kind = RuleKind::within;
  double expected = 0.0;
  double tolerance = 0.0;  // of `within`
};

enum class Verdict { reproduced, not_reproduced, undecidable };

/// Reproduced if the whole interval obeys the rule, not reproduced if no part of it does. Undecidable otherwise, for
/// numbers that are not finite, and without a measurement.
Verdict judge(const Rule& rule, const std::optional<Measured>& measured);

/// Fewer runs cannot show a majority: even if all of them obey, the interval of the share contains one half.
inline constexpr std::size_t kRunsForShare = 4;

/// Number of runs that obey a rule, and the interval of their share by Wilson's score.
struct HeldShare {
  std::size_t holds = 0;
  std::size_t runs = 0;
  double low = 0.0;
  double high = 0.0;
};
/// The share of runs that obey the rule; empty for fewer than kRunsForShare runs.
std::optional<HeldShare> held_share(const Rule& rule, const std::vector<double>& each);

/// A statement about each run holds if more than the share `least` of all runs would obey it: reproduced if the
/// interval of the share lies above `least`, not reproduced if it lies below, undecidable otherwise.
Verdict judge_share(const HeldShare& share, double least);

std::string verdict_text(Verdict verdict);
/// "72 +- 3.6", "> 1", "< 0.5", "p < 0.05".
std::string rule_text(const Rule& rule);
/// The rule with this name in a file of statements; empty for an unknown name.
std::optional<RuleKind> rule_kind(const std::string& name);

/// How the numbers of several runs are combined.
enum class Over {
  mean,    // mean with its interval over the runs; for one run its own interval, if any
  every,   // median, with the range from the smallest to the largest; the share of runs that obey decides
  chances  // probabilities of independent runs, combined
};

/// A number of one run; low and high equal value if one run gives no interval.
struct RunNumber {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  bool interval = false;
};

/// Empty without runs. Runs whose seeds change nothing count as one. With `mean`, a single draw without an interval
/// gets infinite ends: one run says nothing about an average.
std::optional<Measured> over_runs(const std::vector<RunNumber>& runs, Over over);

}  // namespace gem
