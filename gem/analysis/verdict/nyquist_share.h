// How much of a force changes from one time step to the next: a number without a spectrum, gathered step by step.
//
//   N = sum |F_i - F_(i-1)|^2 / (4 sum |F_i - mean|^2)
//
// A sample has the power S(f) at the frequency f. Differences have S(f) 4 sin^2(pi f dt). So N is the share of the
// variance in which every frequency counts by sin^2(pi f dt): 0 at f = 0, 1/2 at a quarter of the step frequency, 1 at
// the Nyquist frequency.
//
//   N = 0    a force that the time steps resolve
//   N = 1/2  white noise; also single hits at random, one time step each
//   N = 1    a force that is on in one time step and off in the next
//
// At least 2 N - 1 of the variance lies above a quarter of the step frequency (there sin^2 >= 1/2), at most 2 N.
#pragma once

#include <cmath>
#include <cstdint>

#include "gem/base/vec2.h"

namespace gem {

class NyquistShare {
 public:
  /// Adds the force of the next time step [N]; any unit will do, as long as it stays the same.
  void add(Vec2 force) {
    if (count_ > 0) differences_ += square(force - last_);
    last_ = force;
    loaded_ += force.x != 0.0 || force.y != 0.0;
    // Welford 1962: no difference of large sums
    const Vec2 before = force - mean_;
    mean_ += (1.0 / static_cast<double>(++count_)) * before;
    squares_ += dot(before, force - mean_);
  }

  /// N; NaN if the force never changed.
  double value() const { return squares_ > 0.0 ? differences_ / (4.0 * squares_) : std::nan(""); }
  /// Time steps with a force.
  std::int64_t loaded() const { return loaded_; }

 private:
  static double square(Vec2 v) { return dot(v, v); }

  Vec2 last_, mean_;
  double squares_ = 0.0, differences_ = 0.0;
  std::int64_t count_ = 0, loaded_ = 0;
};

}  // namespace gem
