// The null model of the platform's motion: a linear, lightly damped oscillator that is hit at random times.
//
//   x'' + 2 zeta omega x' + omega^2 x = sum of v_j delta(t - t_j)
//
// x position, omega = 2 pi / natural period, zeta damping ratio, t_j times of a Poisson process, v_j speed change by an
// impulse. The model is neither chaotic nor nonlinear, yet its amplitude wanders and its records differ. Whatever a run
// shows beyond the model needs another explanation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gem {

struct ImpulseOscillator {
  double natural_period = 88.858;  // undamped [s]
  double damping_ratio = 0.005;    // of critical, below 1
  double impulse_rate = 0.1;       // mean number of impulses per second [1/s]
  double speed_mean = 0.0;         // mean speed change by an impulse [m/s]
  double speed_deviation = 1e-3;   // its standard deviation [m/s]
};

struct OscillatorRecord {
  std::vector<double> position;  // [m]
  std::vector<double> velocity;  // [m/s]
};

/// `samples` of the model at the given interval, started from rest at t = 0. Motion between impulses is exact for any
/// interval. The impulses depend only on the seed. Throws std::invalid_argument for values out of range.
OscillatorRecord impulse_oscillator(const ImpulseOscillator& model, std::size_t samples, double interval_s,
                                    std::uint64_t seed);

}  // namespace gem
