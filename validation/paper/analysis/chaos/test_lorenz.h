// The Lorenz system, whose largest Lyapunov exponent is known: 0.9056 per unit of time.
#pragma once

#include <array>
#include <cmath>

namespace gem {

inline constexpr double kLorenzExponent = 0.9056;

class Lorenz {
 public:
  /// A state on the attractor; different `start` give different states.
  explicit Lorenz(double start) : state_{1.0 + start, 1.0, 20.0} { advance(20.0); }

  void disturb(double size) { state_[0] += size; }
  double distance(const Lorenz& other) const {
    return std::hypot(state_[0] - other.state_[0], state_[1] - other.state_[1], state_[2] - other.state_[2]);
  }
  /// Fourth-order Runge-Kutta in steps of about 0.005.
  void advance(double time) {
    const auto steps = static_cast<int>(std::lround(time / 0.005));
    for (int i = 0; i < steps; ++i) step(time / steps);
  }

 private:
  using State = std::array<double, 3>;
  static State rate(const State& s) {
    return {10.0 * (s[1] - s[0]), s[0] * (28.0 - s[2]) - s[1], s[0] * s[1] - 8.0 / 3.0 * s[2]};
  }
  static State moved(const State& s, const State& by, double time) {
    return {s[0] + time * by[0], s[1] + time * by[1], s[2] + time * by[2]};
  }
  void step(double h) {
    const State a = rate(state_);
    const State b = rate(moved(state_, a, 0.5 * h));
    const State c = rate(moved(state_, b, 0.5 * h));
    const State d = rate(moved(state_, c, h));
    for (std::size_t i = 0; i < 3; ++i) state_[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
  }

  State state_;
};

}  // namespace gem
