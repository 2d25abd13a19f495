// Time series and events as a packet for the page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gem/record/run_file/run_file.h"

namespace gem::view {

/// Which columns of a group of a run file, and which rows.
struct RowChoice {
  std::string group;  ///< "platform", "events" or "stats"
  std::vector<std::string> columns;
  std::size_t first = 0;
  std::size_t bucket = 1;  ///< of each so many rows only the one with the largest `by` is packed
  std::string by_x, by_y;  ///< columns of a vector; empty: the last row of a bucket
};

/// A packet of the chosen columns that the file holds, with unit and meaning. A value is kept to 1/131072 of the
/// largest of its column, a time to 1e-6 s. Throws Error(file_system) if the file cannot be read.
std::string pack_rows(const RunFile& file, const RowChoice& choice);

}  // namespace gem::view
