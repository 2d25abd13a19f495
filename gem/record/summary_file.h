// One HDF5 file with one row per run, which netCDF readers such as xarray open: settings are its coordinates.
#pragma once

#include <string>
#include <vector>

namespace gem {

/// What is known of every run: numbers (NaN where a run has none) or texts, whichever is not empty.
struct SummaryColumn {
  std::string name;
  std::string units;  // "1" without dimension; unused for texts
  std::string long_name;
  bool is_setting = false;  // a coordinate: what was asked for, not what came out
  std::vector<double> numbers = {};
  std::vector<std::string> texts = {};
};

/// A record over time of every run, run by run; NaN after the end of a run.
struct SummarySeries {
  std::string name, units, long_name;
  std::vector<float> values;  // [run][time]
};

struct SummaryTable {
  std::string title;
  std::string history;            // the command that made it
  std::vector<std::string> runs;  // names
  std::vector<double> time;       // of the series [s]
  std::vector<SummaryColumn> columns;
  std::vector<SummarySeries> series;
};

/// Writes the table at one stroke: `path` is the whole file or stays as it was. Throws Error(file_system) if it exists
/// (and not overwrite) or cannot be written.
void write_summary(const std::string& path, bool overwrite, const SummaryTable& table);

}  // namespace gem
