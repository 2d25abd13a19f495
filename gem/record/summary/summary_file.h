// An HDF5 file with one row per run, readable by netCDF readers such as xarray. Settings are its coordinates.
#pragma once

#include <string>
#include <vector>

namespace gem {

/// One value per run: numbers (NaN where a run has none) or texts. The other vector is empty.
struct SummaryColumn {
  std::string name;
  std::string units;  // "1" if dimensionless; not used for texts
  std::string long_name;
  bool is_setting = false;  // a coordinate: an input of the run, not a result
  std::vector<double> numbers = {};
  std::vector<std::string> texts = {};
};

/// The points of a series, e.g. times. The name is that of the dataset.
struct SummaryAxis {
  std::string name, units, long_name;
  std::vector<double> values;
};

/// One record per run along an axis. NaN where a run has no value.
struct SummarySeries {
  std::string name, units, long_name;
  std::string axis;                 // name of the axis
  bool exact = false;               // stored in double precision, else in single
  std::vector<double> values = {};  // [run][axis]
};

struct SummaryTable {
  std::string title;
  std::string history;            // the command that made the table
  std::vector<std::string> runs;  // names
  std::vector<SummaryAxis> axes;
  std::vector<SummaryColumn> columns;
  std::vector<SummarySeries> series;

  /// The axis, column or series of this name; null if there is none.
  const SummaryAxis* axis(const std::string& name) const;
  const SummaryColumn* column(const std::string& name) const;
  const SummarySeries* one_series(const std::string& name) const;
};

/// Writes the table in one step: either `path` becomes the complete file, or it stays unchanged. Throws
/// Error(file_system) if it exists (and not overwrite) or cannot be written.
void write_summary(const std::string& path, bool overwrite, const SummaryTable& table);

/// Whether an HDF5 file is a summary, i.e. lists runs. False for a file that cannot be read.
bool is_summary(const std::string& path);

/// Reads a summary. Numbers have the values that were written (single precision for a series that is not exact). Throws
/// Error(file_system) if the file cannot be read, is not a summary, or has columns, series and scales of different
/// lengths.
SummaryTable read_summary(const std::string& path);

}  // namespace gem
