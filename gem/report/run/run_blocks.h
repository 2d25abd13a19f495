// A run divided into blocks of equal length: shows growth, and the largest value per block.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/analysis/run_analysis.h"

namespace gem {

inline constexpr double kBlockLength =
    600.0;  // [s]: about seven natural periods, so that blocks are nearly independent

/// One value per block; an incomplete block at the end is left out.
struct RunBlocks {
  std::vector<double> mean_x;             // [m]
  std::vector<double> deviation_x;        // about the mean of the block [m]
  std::vector<double> deviation_y;        // [m]
  std::vector<double> largest_excursion;  // distance from rest [m]
  std::vector<double> largest_ice_force;  // magnitude of the window mean [N]

  std::size_t count() const { return mean_x.size(); }
};

RunBlocks run_blocks(const PlatformSeries& series, double length_s = kBlockLength);

}  // namespace gem
