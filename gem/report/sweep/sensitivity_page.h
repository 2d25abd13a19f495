// The page of a sweep with drawn inputs: loads, shares of their scatter, pictures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/sensitivity/study.h"

namespace gem {

struct SensitivityPage {
  std::string sweep;  // its name
  Study study;
  std::vector<ConditionEffects> effects;
  std::size_t listed = 0;  // runs that the sweep has, with those that are not done
  double from_s = 0.0;     // earlier times were left out
};

/// Writes out_dir/index.html with its figures, and runs.csv with the inputs and outputs of every run. Throws
/// Error(file_system) if gnuplot is missing or something cannot be written, Error(usage) if the folder holds another
/// page.
void write_sensitivity_page(const SensitivityPage& page, const std::string& out_dir);

/// Only the table of the page: inputs and results of each run as CSV. Throws Error(file_system).
void write_sensitivity_runs(const SensitivityPage& page, const std::filesystem::path& path);

/// The same as text for the terminal.
std::string sensitivity_text(const SensitivityPage& page);

/// What an output is, in words; its name if it has none.
std::string output_words(const std::string& name);

/// An output with its unit: "12.3 kN".
std::string output_text(const std::string& name, double value);

/// "a [b, c] kN".
std::string output_text(const std::string& name, const IntervalEstimate& estimate);

/// The share that pictures show: total for seeds; else first order in a Saltelli design, else that of a monotone trend.
std::optional<IntervalEstimate> leading_share(const StudyInput& input, const InputEffect& effect);

/// A share in per cent: "42 [31, 55] %"; "-" without one.
std::string share_text(const std::optional<IntervalEstimate>& share);

}  // namespace gem
