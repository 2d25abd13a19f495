// Moments and extremes of each block.
#include "gem/report/run/run_blocks.h"

#include <cmath>
#include <span>

#include "gem/analysis/statistics/moments.h"

namespace gem {

RunBlocks run_blocks(const PlatformSeries& series, double length_s) {
  RunBlocks blocks;
  const auto samples = static_cast<std::size_t>(std::llround(length_s / series.interval));
  for (std::size_t begin = 0; samples > 0 && begin + samples <= series.x.size(); begin += samples) {
    const auto stretch = [&](const std::vector<double>& column) { return std::span(column).subspan(begin, samples); };
    const Moments x = moments(stretch(series.x));
    blocks.mean_x.push_back(x.mean);
    blocks.deviation_x.push_back(x.deviation);
    blocks.deviation_y.push_back(moments(stretch(series.y)).deviation);
    blocks.largest_excursion.push_back(maximum_radial_excursion(stretch(series.x), stretch(series.y)).value);
    blocks.largest_ice_force.push_back(
        maximum_radial_excursion(stretch(series.ice_force_window_x), stretch(series.ice_force_window_y)).value);
  }
  return blocks;
}

}  // namespace gem
