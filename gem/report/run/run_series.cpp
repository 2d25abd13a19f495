// Peaks per natural period, and blocks.
#include "gem/report/run/run_series.h"

#include <span>

#include "gem/analysis/statistics/moments.h"

namespace gem {

RunSeries run_series(const PlatformSeries& series) {
  RunSeries result;
  result.blocks = run_blocks(series);
  const auto period = static_cast<std::size_t>(series.natural_period / series.interval);
  for (std::size_t begin = 0; period > 0 && begin + period <= series.x.size(); begin += period)
    result.excursion_peaks.push_back(
        maximum_radial_excursion(std::span(series.x).subspan(begin, period), std::span(series.y).subspan(begin, period))
            .value);
  return result;
}

}  // namespace gem
