// The matrix in which the runs of a sweep are shown, read from their names.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gem {

/// Names such as 004_400_25: the last two parts are the column (the last one, if two give too many), the rest the row.
/// `cell[row][column]` is the index of a run, empty where the sweep has none. Without such names one column and one row
/// per run.
struct SweepLayout {
  std::vector<std::string> rows, columns;  // in the order of first appearance
  std::vector<std::vector<std::optional<std::size_t>>> cell;
};

/// The widest matrix that a page shows.
inline constexpr std::size_t kSweepColumns = 9;

SweepLayout sweep_layout(const std::vector<std::string>& names);

}  // namespace gem
