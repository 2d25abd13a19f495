// A run report for people: one HTML page, its figures, and the numbers and scripts behind them.
#pragma once

#include <string>

#include "gem/report/run/run_data.h"

namespace gem {

/// Writes out_dir/index.html, out_dir/figures/*.svg and the CSV and gnuplot script of each figure from a run file.
/// Throws Error(file_system) if the file cannot be read, gnuplot is missing or something cannot be written, and
/// Error(usage) for a run that is not complete, unless `allow_incomplete`: then the page says so at its top.
void write_report(const std::string& run_file, const std::string& out_dir, bool allow_incomplete);

/// The same from data in memory.
void write_report(const RunData& run, const std::string& out_dir, bool allow_incomplete);

}  // namespace gem
