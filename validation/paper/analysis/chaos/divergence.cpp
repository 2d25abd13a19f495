// Fits lines to logarithms of distances.
#include "validation/paper/analysis/chaos/divergence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "validation/paper/analysis/fits/line_fit.h"

namespace gem {
namespace {

constexpr std::size_t kFewestStretchSamples = 6;

using Logs = std::vector<std::vector<double>>;

Logs logs_of(const std::vector<std::vector<double>>& pairs) {
  Logs logs;
  for (const std::vector<double>& pair : pairs) {
    if (pair.size() != pairs.front().size()) throw std::invalid_argument("the pairs have different lengths");
    std::vector<double>& log = logs.emplace_back();
    for (const double distance : pair) {
      if (!(distance > 0.0)) throw std::invalid_argument("a distance of zero has no logarithm");
      log.push_back(std::log(distance));
    }
  }
  return logs;
}

std::vector<double> mean_of(const Logs& logs, std::span<const std::size_t> chosen) {
  std::vector<double> mean(logs.front().size(), 0.0);
  for (const std::size_t pair : chosen)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += logs[pair][i] / static_cast<double>(chosen.size());
  return mean;
}

struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
};

Stretch growing_stretch(const std::vector<double>& curve, double low, double high) {
  const auto reaches = [&curve](double level) {
    const auto found = std::find_if(curve.begin(), curve.end(), [level](double value) { return value >= level; });
    return static_cast<std::size_t>(found - curve.begin());
  };
  return {reaches(std::log(low)), reaches(std::log(high))};
}

double slope_of(const std::vector<double>& curve, std::size_t begin, std::size_t end, double interval_s) {
  std::vector<double> time;
  for (std::size_t i = begin; i < end; ++i) time.push_back(static_cast<double>(i) * interval_s);
  return fit_line(time, std::span(curve).subspan(begin, end - begin)).slope.value;
}

}  // namespace

std::vector<double> mean_log_distance(const std::vector<std::vector<double>>& pairs) {
  if (pairs.empty()) throw std::invalid_argument("no pairs to average");
  std::vector<std::size_t> all(pairs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return mean_of(logs_of(pairs), all);
}

std::optional<GrowthRate> growth_rate(const std::vector<std::vector<double>>& pairs, double interval_s, double low,
                                      double high, const Resampling& resampling) {
  const Stretch stretch = growing_stretch(mean_log_distance(pairs), low, high);
  if (stretch.end < stretch.begin + kFewestStretchSamples) return std::nullopt;
  const std::size_t middle = (stretch.begin + stretch.end) / 2;
  const Logs logs = logs_of(pairs);
  const std::vector<IntervalEstimate> slopes = bootstrap_together(
      pairs.size(),
      [&](std::span<const std::size_t> chosen) {
        const std::vector<double> curve = mean_of(logs, chosen);
        return std::vector<double>{slope_of(curve, stretch.begin, stretch.end, interval_s),
                                   slope_of(curve, stretch.begin, middle, interval_s),
                                   slope_of(curve, middle, stretch.end, interval_s)};
      },
      resampling);
  return GrowthRate{slopes[0], slopes[1], slopes[2], static_cast<double>(stretch.begin) * interval_s,
                    static_cast<double>(stretch.end) * interval_s};
}

std::optional<double> onset_time(std::span<const double> distance, double interval_s, double level) {
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (distance[i] < level) continue;
    const auto time = static_cast<double>(i);
    if (i == 0 || !(distance[i - 1] > 0.0)) return time * interval_s;
    const double share = std::log(distance[i] / level) / std::log(distance[i] / distance[i - 1]);
    return (time - share) * interval_s;
  }
  return std::nullopt;
}

OnsetShift onset_shift(std::span<const double> sizes, std::span<const double> onsets,
                       std::span<const std::uint64_t> field) {
  std::vector<double> log_size;
  for (const double size : sizes) {
    if (!(size > 0.0)) throw std::invalid_argument("a disturbance of zero has no logarithm");
    log_size.push_back(std::log(size));
  }
  const IntervalEstimate shift = common_slope(log_size, onsets, field);
  const auto rate = [](double slope) { return slope < 0.0 ? -1.0 / slope : std::numeric_limits<double>::infinity(); };
  // A steeper shift means slower growth, so low and high change places.
  return {shift, {rate(shift.value), rate(shift.low), rate(shift.high)}};
}

}  // namespace gem
