// A run cut into stretches of equal length: what grows, and how large the largest of a stretch is.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/analysis/run_analysis.h"

namespace gem {

inline constexpr double kBlockLength = 600.0;  // [s]: about seven natural periods, so blocks are nearly independent

/// One value per stretch; a stretch that the run does not fill is left out.
struct RunBlocks {
  std::vector<double> mean_x;             // [m]
  std::vector<double> deviation_x;        // about the mean of the stretch [m]
  std::vector<double> deviation_y;        // [m]
  std::vector<double> largest_excursion;  // distance from rest [m]
  std::vector<double> largest_ice_force;  // size of the window mean [N]

  std::size_t count() const { return mean_x.size(); }
};

RunBlocks run_blocks(const PlatformSeries& series, double length_s = kBlockLength);

}  // namespace gem
