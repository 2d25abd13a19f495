// Compares the motion with a linear oscillator that is hit at random times.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gem/analysis/spectra/hilbert.h"
#include "gem/analysis/statistics/correlation.h"
#include "gem/analysis/statistics/moments.h"
#include "validation/paper/analysis/chaos/nonlinearity.h"
#include "validation/paper/analysis/chaos/null_hypothesis.h"
#include "validation/paper/analysis/chaos/zero_one.h"
#include "validation/paper/runs/null_model.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {
namespace {

constexpr std::size_t kFewestSamples = 110;  // of the thinned record: the 0-1 test needs 100
constexpr std::size_t kRecords = 99;         // of the null model: the smallest two-sided p is 0.02
constexpr double kMostDamping = 0.5;         // of a record that loses its memory within one period
constexpr std::size_t kPerPeriod = 4;        // samples of the thinned record

std::vector<double> without_mean(std::vector<double> signal) {
  const double mean = moments(signal).mean;
  for (double& value : signal) value -= mean;
  return signal;
}

/// The time at which the amplitude changes most, in samples, and how clearly.
struct Change {
  std::size_t sample = 0;
  double size = 0.0;  // sum of deviations from the mean logarithm, over sqrt(n) standard deviations
};

/// Largest cumulative sum of the logarithm of the amplitude around the natural period, with one value per period.
Change amplitude_change(std::span<const double> signal) {
  const HilbertEnvelope envelope = hilbert_envelope(signal, 1.0, 0.5 / kPerPeriod, 1.5 / kPerPeriod);
  std::vector<double> level;
  for (std::size_t i = kPerPeriod; i + kPerPeriod < envelope.amplitude.size(); i += kPerPeriod)
    level.push_back(std::log(std::max(envelope.amplitude[i], 1e-300)));
  const Moments about = moments(level);
  Change change;
  double sum = 0.0;
  for (std::size_t i = 0; i < level.size(); ++i) {
    sum += level[i] - about.mean;
    const double size = std::abs(sum) / (about.deviation * std::sqrt(static_cast<double>(level.size())));
    if (size > change.size) change = {(i + 2) * kPerPeriod, size};
  }
  return change;
}

/// Damping ratio of a linear oscillator whose correlation decays as much in one period as that of the record.
double damping_by_memory(std::span<const double> signal) {
  const double left = autocorrelation(signal, kPerPeriod).back();
  return left > 0.0 ? -std::log(left) / (2.0 * std::numbers::pi) : kMostDamping;
}

double predictability(std::span<const double> signal) { return prediction_error(signal, {{3, 1, kPerPeriod}, 1, 10}); }

void add_axis(const std::string& axis, const std::vector<double>& signal, double step, const SignalGenerator& records,
              Numbers& numbers) {
  const auto k = [](std::span<const double> s) { return zero_one_test(s).k; };
  const NullTest zero_one = test_against(signal, k, records, kRecords);
  numbers.add(axis + "_zero_one_k", zero_one.observed);
  numbers.add(axis + "_zero_one_k_null_median", percentile(zero_one.of_null, 0.5));
  numbers.add(axis + "_zero_one_p", zero_one.two_sided());
  const NullTest prediction = test_against(signal, predictability, records, kRecords);
  numbers.add(axis + "_prediction_error", prediction.observed);
  numbers.add(axis + "_prediction_error_null_median", percentile(prediction.of_null, 0.5));
  numbers.add(axis + "_prediction_p", prediction.two_sided());
  const auto asymmetry = [](std::span<const double> s) { return time_reversal_asymmetry(s, 1); };
  numbers.add(axis + "_asymmetry_p", test_against(signal, asymmetry, records, kRecords).two_sided());
  const auto size = [](std::span<const double> s) { return amplitude_change(s).size; };
  numbers.add(axis + "_change_p", test_against(signal, size, records, kRecords).p_high);
  numbers.add(axis + "_change_s", static_cast<double>(amplitude_change(signal).sample) * step);
}

}  // namespace

void add_chaos_numbers(const NumberSource& source, Numbers& numbers) {
  const PlatformSeries& series = source.series;
  const PlatformLoads& loads = source.loads;
  const auto model = null_model(source.scene, static_cast<double>(loads.touches) / source.data.duration_s);
  if (!model) return;
  const auto every =
      static_cast<std::size_t>(series.natural_period / static_cast<double>(kPerPeriod) / series.interval);
  if (every == 0 || series.x.size() / every < kFewestSamples) return;
  const double step = static_cast<double>(every) * series.interval;
  const std::size_t samples = (series.x.size() + every - 1) / every;
  for (const auto& [axis, motion] : {std::pair("x", &series.x), std::pair("y", &series.y)}) {
    const std::vector<double> signal = without_mean(every_nth(*motion, every));
    // Dense ice damps more than single floes. The null model must not be rejected for that reason alone.
    ImpulseOscillator damped = *model;
    damped.damping_ratio = std::clamp(damping_by_memory(signal), model->damping_ratio, kMostDamping);
    numbers.add(std::string(axis) + "_null_damping_ratio", damped.damping_ratio);
    const SignalGenerator records = [&](std::uint64_t seed) {
      return without_mean(impulse_oscillator(damped, samples, step, seed).position);
    };
    add_axis(axis, signal, step, records, numbers);
  }
}

}  // namespace gem
