// A run report for people: one HTML page, its figures, and the numbers and scripts behind them.
#pragma once

#include <optional>
#include <string>

#include "gem/report/run/run_data.h"

namespace gem {

/// Writes out_dir/index.html, out_dir/figures/*.svg and the CSV and gnuplot script of each figure. Throws
/// Error(file_system) if the run file cannot be read, gnuplot is missing or something cannot be written. Throws
/// Error(usage) for an incomplete run, unless `allow_incomplete`: then the page says at its top that the run is
/// incomplete. `at_s` is the time of the field and of the extract of the forces; empty: the middle of the run,
/// and where most impacts are. Throws Error(usage) if it is not within the run.
void write_report(const std::string& run_file, const std::string& out_dir, bool allow_incomplete,
                  std::optional<double> at_s = {});

/// Writes the report of data in memory.
void write_report(const RunData& run, const std::string& out_dir, bool allow_incomplete);

}  // namespace gem
