// Exact motion from one impulse to the next.
#include "validation/paper/analysis/chaos/impulse_oscillator.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "gem/analysis/statistics/random_streams.h"

namespace gem {
namespace {

struct State {
  double position = 0.0;
  double velocity = 0.0;
};

/// Free motion over a time.
class FreeMotion {
 public:
  explicit FreeMotion(const ImpulseOscillator& model)
      : decay_(model.damping_ratio * 2.0 * std::numbers::pi / model.natural_period),
        turn_(2.0 * std::numbers::pi / model.natural_period *
              std::sqrt(1.0 - model.damping_ratio * model.damping_ratio)) {}

  State after(const State& state, double time) const {
    const double shrink = std::exp(-decay_ * time);
    const double cosine = std::cos(turn_ * time);
    const double sine = std::sin(turn_ * time) / turn_;
    const double push = state.velocity + decay_ * state.position;
    const double stiffness = decay_ * decay_ + turn_ * turn_;
    return {shrink * (state.position * cosine + push * sine),
            shrink * (state.velocity * cosine - (stiffness * state.position + decay_ * state.velocity) * sine)};
  }

 private:
  double decay_;
  double turn_;
};

void check(const ImpulseOscillator& model, double interval_s) {
  if (!(model.natural_period > 0.0) || !(model.damping_ratio >= 0.0 && model.damping_ratio < 1.0) ||
      !(model.impulse_rate > 0.0) || !(model.speed_deviation >= 0.0) || !(interval_s > 0.0))
    throw std::invalid_argument("the oscillator needs a period, light damping, a rate of impulses and an interval");
}

}  // namespace

OscillatorRecord impulse_oscillator(const ImpulseOscillator& model, std::size_t samples, double interval_s,
                                    std::uint64_t seed) {
  check(model, interval_s);
  const FreeMotion motion(model);
  RandomSequence times = random_sequence(seed, AnalysisStream::impulse_times);
  RandomSequence sizes = random_sequence(seed, AnalysisStream::impulse_sizes);
  const auto wait = [&] { return -std::log(times.uniform()) / model.impulse_rate; };
  OscillatorRecord record;
  State state;
  double now = 0.0;
  double next = wait();
  for (std::size_t i = 0; i < samples; ++i) {
    const double sample = static_cast<double>(i) * interval_s;
    for (; next <= sample; next += wait()) {
      state = motion.after(state, next - now);
      state.velocity += model.speed_mean + model.speed_deviation * sizes.normal();
      now = next;
    }
    state = motion.after(state, sample - now);
    now = sample;
    record.position.push_back(state.position);
    record.velocity.push_back(state.velocity);
  }
  return record;
}

}  // namespace gem
