// Logarithmic decrement by a line through all extremes.
#include "gem/analysis/free_decay.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "gem/analysis/line_fit.h"

namespace gem {
namespace {

struct Extremes {
  std::vector<double> number, time, log_size;
};

/// The extreme between zero crossings, refined by the parabola through the samples next to it.
void add_extreme(Extremes& extremes, std::span<const double> signal, std::size_t at, double interval_s, double rest) {
  const double before = signal[at - 1] - rest;
  const double here = signal[at] - rest;
  const double after = signal[at + 1] - rest;
  const double bend = before - 2.0 * here + after;
  const double shift = bend != 0.0 ? 0.5 * (before - after) / bend : 0.0;
  extremes.number.push_back(static_cast<double>(extremes.number.size()));
  extremes.time.push_back((static_cast<double>(at) + shift) * interval_s);
  extremes.log_size.push_back(std::log(std::abs(here - 0.25 * (before - after) * shift)));
}

/// One extreme per swing to a side: the sample furthest from rest between two crossings of it.
Extremes find_extremes(std::span<const double> signal, double interval_s, double rest, double floor) {
  Extremes extremes;
  std::size_t furthest = 0;
  bool whole = false;  // the first swing may have begun before the record
  for (std::size_t i = 1; i < signal.size(); ++i) {
    const bool crosses = (signal[i] - rest) * (signal[i - 1] - rest) <= 0.0 && signal[i] != rest;
    if (crosses) {
      if (whole) {
        if (std::abs(signal[furthest] - rest) <= floor) break;
        add_extreme(extremes, signal, furthest, interval_s, rest);
      }
      whole = true;
      furthest = i;
    } else if (std::abs(signal[i] - rest) > std::abs(signal[furthest] - rest)) {
      furthest = i;
    }
  }
  return extremes;
}

double ratio_of(double half_decrement) {
  const double half_turn = std::numbers::pi;
  return half_decrement / std::sqrt(half_turn * half_turn + half_decrement * half_decrement);
}

}  // namespace

std::optional<FreeDecay> free_decay(std::span<const double> signal, double interval_s, double rest, double floor) {
  const Extremes extremes = find_extremes(signal, interval_s, rest, floor);
  if (extremes.number.size() < 4) return std::nullopt;
  const Estimate half_period = fit_line(extremes.number, extremes.time).slope;
  const Estimate fall = fit_line(extremes.number, extremes.log_size).slope;
  FreeDecay decay;
  decay.half_cycles = extremes.number.size() - 1;
  decay.period = {2.0 * half_period.value, 2.0 * half_period.low, 2.0 * half_period.high};
  decay.damping_ratio = {ratio_of(-fall.value), ratio_of(-fall.high), ratio_of(-fall.low)};
  const double shortening = std::sqrt(1.0 - decay.damping_ratio.value * decay.damping_ratio.value);
  decay.natural_period = {decay.period.value * shortening, decay.period.low * shortening,
                          decay.period.high * shortening};
  return decay;
}

}  // namespace gem
