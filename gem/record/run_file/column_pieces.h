// Reads columns of any length piece by piece, so that memory does not grow with the length of a run.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "gem/engine/step/overlap_count.h"
#include "gem/record/run_file/run_file.h"

namespace gem {

/// Some rows of columns that belong together.
struct ColumnPiece {
  std::size_t first = 0;                    // row
  std::size_t rows = 0;                     // how many
  std::vector<std::vector<double>> values;  // of each column, row by row
};

/// Calls `visit` with all rows of these datasets, in order and some megabytes at a time. Throws Error(file_system) that
/// names the file if the datasets differ in length or cannot be read.
void for_each_piece(const RunFile& file, const std::vector<std::string>& datasets,
                    const std::function<void(const ColumnPiece&)>& visit);

/// The largest value of a column; 0 if the file has none, or none with rows.
double largest_value(const RunFile& file, const std::string& dataset);

/// The last value of a column; 0 if the file has none, or none with rows.
double last_value(const RunFile& file, const std::string& dataset);

/// All overlaps of a run by size class, from stats/overlap_count or stats/overlap_share_count. Empty if the file has no
/// such dataset.
OverlapCount overlaps_of(const RunFile& file, const std::string& dataset);

}  // namespace gem
