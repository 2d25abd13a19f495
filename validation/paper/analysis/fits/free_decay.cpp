// Logarithmic decrement by a line through all swings.
#include "validation/paper/analysis/fits/free_decay.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "validation/paper/analysis/fits/line_fit.h"

namespace gem {
namespace {

/// Times at which the record crosses from beyond `floor` on one side of rest to beyond it on the other [s]. If noise
/// crosses several times, their mean counts.
std::vector<double> swing_crossings(std::span<const double> signal, double interval_s, double rest, double floor) {
  std::vector<double> times;
  double side = 0.0;
  double sum = 0.0;
  double crossed = 0.0;
  for (std::size_t i = 1; i < signal.size(); ++i) {
    const double before = signal[i - 1] - rest;
    const double here = signal[i] - rest;
    if ((before < 0.0) != (here < 0.0)) {
      sum += (static_cast<double>(i) - here / (here - before)) * interval_s;
      crossed += 1.0;
    }
    if (std::abs(here) <= floor) continue;
    if (side * here < 0.0) times.push_back(sum / crossed);
    side = here;
    sum = crossed = 0.0;
  }
  return times;
}

/// Integral of the record about rest from its start to any time, by the trapezoidal rule.
class Integral {
 public:
  Integral(std::span<const double> signal, double interval_s, double rest)
      : signal_(signal), interval_s_(interval_s), rest_(rest), sum_(signal.size(), 0.0) {
    for (std::size_t i = 1; i < signal.size(); ++i)
      sum_[i] = sum_[i - 1] + 0.5 * interval_s * (signal[i - 1] + signal[i] - 2.0 * rest);
  }

  double until(double time) const {
    const auto i = std::min(static_cast<std::size_t>(time / interval_s_), signal_.size() - 2);
    const double share = time / interval_s_ - static_cast<double>(i);
    const double begin = signal_[i] - rest_;
    const double end = begin + share * (signal_[i + 1] - signal_[i]);
    return sum_[i] + 0.5 * share * interval_s_ * (begin + end);
  }

 private:
  std::span<const double> signal_;
  double interval_s_;
  double rest_;
  std::vector<double> sum_;
};

double ratio_of(double half_decrement) {
  const double half_turn = std::numbers::pi;
  return half_decrement / std::sqrt(half_turn * half_turn + half_decrement * half_decrement);
}

}  // namespace

std::optional<FreeDecay> free_decay(std::span<const double> signal, double interval_s, double rest, double floor) {
  const std::vector<double> times = swing_crossings(signal, interval_s, rest, floor);
  if (times.size() < 4) return std::nullopt;
  const Integral integral(signal, interval_s, rest);
  std::vector<double> number;
  std::vector<double> log_area;
  for (std::size_t n = 0; n < times.size(); ++n) {
    number.push_back(static_cast<double>(n));
    if (n > 0) log_area.push_back(std::log(std::abs(integral.until(times[n]) - integral.until(times[n - 1]))));
  }
  const IntervalEstimate half_period = fit_line(number, times).slope;
  const IntervalEstimate fall = fit_line(std::span(number).first(log_area.size()), log_area).slope;
  FreeDecay decay;
  decay.half_cycles = log_area.size();
  decay.period = {2.0 * half_period.value, 2.0 * half_period.low, 2.0 * half_period.high};
  decay.damping_ratio = {ratio_of(-fall.value), ratio_of(-fall.high), ratio_of(-fall.low)};
  const double shortening = std::sqrt(1.0 - decay.damping_ratio.value * decay.damping_ratio.value);
  decay.natural_period = {decay.period.value * shortening, decay.period.low * shortening,
                          decay.period.high * shortening};
  return decay;
}

}  // namespace gem
