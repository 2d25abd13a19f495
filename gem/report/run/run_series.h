// The series that a summary keeps of the platform's motion, besides single numbers.
#pragma once

#include <optional>
#include <vector>

#include "gem/report/run/platform_path.h"
#include "gem/report/run/run_blocks.h"

namespace gem {

struct RunSeries {
  std::vector<double> excursion_peaks;  // largest distance from rest per natural period [m]
  RunBlocks blocks;
  std::optional<PlatformPath> path;
};

/// Peaks and blocks of a record, without the path.
RunSeries run_series(const PlatformSeries& series);

}  // namespace gem
