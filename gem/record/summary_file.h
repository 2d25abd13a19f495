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

/// Places along which a series runs, e.g. times. Its name is that of its dataset.
struct SummaryAxis {
  std::string name, units, long_name;
  std::vector<double> values;
};

/// A record of every run along an axis, run by run; NaN where a run has nothing (any more).
struct SummarySeries {
  std::string name, units, long_name;
  std::string axis;                 // its name
  bool exact = false;               // kept in double precision; single otherwise
  std::vector<double> values = {};  // [run][axis]
};

struct SummaryTable {
  std::string title;
  std::string history;            // the command that made it
  std::vector<std::string> runs;  // names
  std::vector<SummaryAxis> axes;
  std::vector<SummaryColumn> columns;
  std::vector<SummarySeries> series;

  /// Nothing if there is none of this name.
  const SummaryAxis* axis(const std::string& name) const;
  const SummaryColumn* column(const std::string& name) const;
  const SummarySeries* one_series(const std::string& name) const;
};

/// Writes the table at one stroke: `path` is the whole file or stays as it was. Throws Error(file_system) if it exists
/// (and not overwrite) or cannot be written.
void write_summary(const std::string& path, bool overwrite, const SummaryTable& table);

/// Whether an HDF5 file is a summary: it lists runs. False for a file that cannot be read.
bool is_summary(const std::string& path);

/// Reads a summary back, numbers as they were written (a series in single precision as rounded). Throws
/// Error(file_system) if the file cannot be read or is no summary, or if its columns, series and scales differ in
/// length.
SummaryTable read_summary(const std::string& path);

}  // namespace gem
