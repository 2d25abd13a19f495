// A study of drawn runs: the results of each condition, and how much of their scatter each input makes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/sensitivity/regression.h"
#include "gem/analysis/sensitivity/sobol.h"

namespace gem {

struct StudyInput {
  std::string name, key, law;
  bool is_seed = false;  // a number without order: no trend is asked for
};

struct StudyRun {
  std::string name;
  std::string condition;  // runs of one condition differ in their inputs alone
  std::int64_t draw = 0;
  std::string part;  // of a Saltelli design: "A", "B" or the name of the input from B; else empty
  std::int64_t repeat = 1;
  std::vector<double> inputs;
  std::vector<double> outputs;  // NaN: the run has no such number
};

struct Study {
  std::vector<StudyInput> inputs;
  std::vector<std::string> outputs;
  std::vector<StudyRun> runs;
};

/// Shares of the variance of one output by one input. What a design does not allow is empty.
struct InputEffect {
  std::optional<TrendShare> linear, monotone;
  std::optional<IntervalEstimate> first, total;  // Sobol indices
};

struct OutputEffects {
  std::string output;
  std::size_t draws = 0, runs = 0;  // with a value
  std::size_t left_out = 0;         // draws of which a run is missing or has no value
  std::optional<IntervalEstimate> mean, deviation, p90;
  double smallest = 0.0, largest = 0.0;
  std::vector<InputEffect> inputs;                             // as the study lists them
  std::optional<double> linear_explained, monotone_explained;  // by all trends together
};

struct ConditionEffects {
  std::string condition;
  std::vector<OutputEffects> outputs;
};

/// Conditions in the order of their first run. 95 % intervals.
std::vector<ConditionEffects> study_effects(const Study& study, const Resampling& resampling = {});

}  // namespace gem
