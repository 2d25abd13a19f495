// Numbers on the platform's motion that the paper's sentences refer to.
#include <algorithm>
#include <cmath>

#include "gem/analysis/orbit.h"
#include "gem/analysis/spectra/hilbert.h"
#include "gem/analysis/spectra/period.h"
#include "gem/analysis/statistics/moments.h"
#include "validation/paper/analysis/fits/free_decay.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {
namespace {

constexpr double kHour = 3600.0;
constexpr double kShort = 600.0;  // duration that would be enough if only the natural period mattered [s]

void add_findings(const PlatformSeries& series, Numbers& numbers) {
  for (const Finding& finding : analyse_platform(series)) {
    if (!finding.value) continue;
    const IntervalEstimate around =
        finding.interval.value_or(IntervalEstimate{*finding.value, *finding.value, *finding.value});
    numbers.add(finding.name, RunNumber{*finding.value, around.low, around.high, finding.interval.has_value()});
  }
}

double variation(const std::vector<double>& values) {
  const Moments about = moments(values);
  return about.deviation / about.mean;
}

double deviation_between(const PlatformSeries& series, const std::vector<double>& signal, double from, double to) {
  const auto at = [&](double time) {
    return std::min(signal.size(), static_cast<std::size_t>(std::llround(time / series.interval)));
  };
  return moments(std::span(signal).subspan(at(from), at(to) - at(from))).deviation;
}

/// Offset over the deviation of the motion about it. An offset whose interval contains zero may be zero.
void add_offset_share(Numbers& numbers) {
  const auto offset = numbers.find("x_offset_m");
  const auto deviation = numbers.find("x_deviation_m");
  if (!offset || !deviation || !(deviation->value > 0.0)) return;
  const RunNumber& mean = *offset;
  const double size = deviation->value;
  const bool holds_zero = mean.low <= 0.0 && mean.high >= 0.0;
  const double ends[] = {std::abs(mean.low) / size, std::abs(mean.high) / size};
  numbers.add("x_offset_over_deviation",
              RunNumber{std::abs(mean.value) / size, holds_zero ? 0.0 : std::min(ends[0], ends[1]),
                        std::max(ends[0], ends[1]), mean.interval});
}

void add_amplitude_variation(const PlatformSeries& series, Numbers& numbers) {
  if (!(series.natural_period > 0.0)) return;
  const auto end = static_cast<std::size_t>(2.0 * series.natural_period / series.interval);
  if (series.x.size() < 6 * end) return;
  const HilbertEnvelope envelope =
      hilbert_envelope(series.x, series.interval, 0.5 / series.natural_period, 1.5 / series.natural_period);
  numbers.add("x_amplitude_variation", variation({envelope.amplitude.begin() + static_cast<std::ptrdiff_t>(end),
                                                  envelope.amplitude.end() - static_cast<std::ptrdiff_t>(end)}));
}

void add_orbit_change(const PlatformSeries& series, Numbers& numbers) {
  const double stretch = 4.0 * series.natural_period;
  if (!(stretch > 0.0) || static_cast<double>(series.x.size()) * series.interval < 3.0 * stretch) return;
  std::vector<double> major, turning;
  for (const Orbit& part : orbit_over_time(series.x, series.y, series.interval, stretch)) {
    major.push_back(part.major);
    turning.push_back(part.turning);
  }
  numbers.add("orbit_size_variation", variation(major));
  const auto [least, most] = std::minmax_element(turning.begin(), turning.end());
  numbers.add("orbit_turning_range", *most - *least);
}

/// Largest excursion of the whole run over that of a typical short part of it.
void add_short_runs(const PlatformSeries& series, Numbers& numbers) {
  const auto length = static_cast<std::size_t>(kShort / series.interval);
  if (series.x.size() < 3 * length) return;
  std::vector<double> largest;
  for (std::size_t begin = 0; begin + length <= series.x.size(); begin += length)
    largest.push_back(
        maximum_radial_excursion(std::span(series.x).subspan(begin, length), std::span(series.y).subspan(begin, length))
            .value);
  numbers.add("largest_over_short", moments(largest).maximum / percentile(largest, 0.5));
}

void add_hours(const PlatformSeries& series, Numbers& numbers) {
  const double duration = series.interval * static_cast<double>(series.x.size() - 1);
  if (duration < 1.9 * kHour) return;
  for (const auto& [axis, signal] : {std::pair("x", &series.x), std::pair("y", &series.y)})
    numbers.add(
        std::string(axis) + "_first_hour_over_second",
        deviation_between(series, *signal, 0.0, kHour) / deviation_between(series, *signal, kHour, 2.0 * kHour));
}

/// Whether a small maximum is counted depends on the sampling: the mean time between all local maxima for each sampling
/// interval.
void add_counted_periods(const PlatformSeries& series, Numbers& numbers) {
  for (const int seconds : {1, 2, 5, 10, 20}) {
    const auto step = static_cast<std::size_t>(std::llround(seconds / series.interval));
    std::vector<double> thin;
    for (std::size_t i = 0; step > 0 && i < series.x.size(); i += step) thin.push_back(series.x[i]);
    if (const auto period = maxima_period(thin, seconds))
      numbers.add("x_period_by_maxima_" + std::to_string(seconds) + "s_s",
                  RunNumber{period->period, period->low, period->high, true});
  }
}

/// Only a run without ice decays freely.
void add_free_decay(const NumberSource& source, Numbers& numbers) {
  if (!source.data.floe_outlines.empty()) return;
  const auto decay = free_decay(source.series.x, source.series.interval);
  if (!decay) return;
  const IntervalEstimate& period = decay->natural_period;
  numbers.add("free_period_s", RunNumber{period.value, period.low, period.high, true});
}

}  // namespace

void add_motion_numbers(const NumberSource& source, Numbers& numbers) {
  const PlatformSeries& series = source.series;
  numbers.add("natural_period_s", series.natural_period);
  add_findings(series, numbers);
  add_offset_share(numbers);
  add_amplitude_variation(series, numbers);
  add_orbit_change(series, numbers);
  add_short_runs(series, numbers);
  add_hours(series, numbers);
  add_counted_periods(series, numbers);
  add_free_decay(source, numbers);
  const auto upstream = std::count_if(series.x.begin(), series.x.end(), [](double x) { return x < 0.0; });
  numbers.add("upstream_share", static_cast<double>(upstream) / static_cast<double>(series.x.size()));
}

}  // namespace gem
