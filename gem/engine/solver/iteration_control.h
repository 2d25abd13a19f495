// Controls the iterations of a coupled time step: extrapolation, rounds and the end.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/macros.h"

namespace gem {

/// Extrapolation factors by iteration (Nesterov 1983): `most` factors for the start of a time step, then `most` factors
/// for a restart at zero. They are tabulated, since each takes a square root and two divisions.
std::vector<float> momentum_coefficients(std::int64_t most);

/// State of the iterations of one time step: how far to extrapolate, when to start a new round, when to stop.
class IterationControl {
 public:
  enum class Next { iteration, round, end };

  /// `residual`: largest speed that a point may still ask for [m/s]; `most`: largest number of iterations; `tight`: the
  /// residual is below the resolution of single precision, so only the first visit of a round can meet it;
  /// `momentum_coefficients`: those of momentum_coefficients(most).
  GEM_HD IterationControl(double residual, std::int64_t most, bool tight, const float* momentum_coefficients)
      : residual_(residual),
        most_(static_cast<std::int32_t>(most)),
        tight_(tight),
        momentum_coefficients_(momentum_coefficients),
        next_coefficient_(momentum_coefficients[0]) {}

  GEM_HD std::int64_t iteration() const { return iteration_; }

  /// Begins an iteration. Returns how far the impulses are extrapolated along their last change.
  GEM_HD float momentum_coefficient() {
    ++iteration_;
    ++of_round_;
    judged_ = iteration_ % 4 == 0 || iteration_ <= 2 || iteration_ == most_ || (tight_ && of_round_ == 1);
    const float now = next_coefficient_;
    // read one iteration ahead, since a device waits for memory; this never reads past the table, as a restart comes no
    // earlier than the second iteration
    next_coefficient_ = momentum_coefficients_[++place_];
    return now;
  }

  /// Whether the residual of this iteration is evaluated: in the first two iterations, in every fourth and in the last,
  /// as it costs two divisions per point. "Every fourth" is a tuned value; up to three iterations may run after
  /// convergence.
  GEM_HD bool judged() const { return judged_; }

  /// What follows an iteration with residual `residual_now` [m/s], which counts only if judged().
  GEM_HD Next after(float residual_now) {
    if (of_round_ == 1) first_ = residual_now;
    if (judged_) watch(residual_now);
    const bool met = judged_ && static_cast<double>(residual_now) <= residual_;
    if (iteration_ >= most_ || (met && (!tight_ || of_round_ == 1))) return Next::end;
    if (of_round_ < longest_round &&
        !(judged_ && tight_ &&
          (met || static_cast<double>(residual_now) <= single_precision * static_cast<double>(first_))))
      return Next::iteration;
    of_round_ = 0;
    return Next::round;
  }

  /// A round reduces the residual by about this factor; smaller residuals need several rounds.
  static constexpr double single_precision = 1e-6;

 private:
  /// A longer round would let the rounding of single precision grow. Chosen by hand.
  static constexpr std::int64_t longest_round = 32;

  /// Restarts the extrapolation when the residual has grown well beyond its lowest value. The effect of the restart is
  /// in validation/solver_study.md ("restart by residual"); the factor 2 was chosen by hand.
  GEM_HD void watch(float residual_now) {
    constexpr float well_beyond = 2.0F;
    const bool overshot = lowest_ > 0.0F && residual_now > well_beyond * lowest_;
    if (overshot) {
      place_ = most_;
      next_coefficient_ = momentum_coefficients_[place_];
    }
    if (overshot || lowest_ == 0.0F || residual_now < lowest_) lowest_ = residual_now;
  }

  double residual_;
  std::int32_t most_;
  bool tight_, judged_ = false;
  const float* momentum_coefficients_;
  float next_coefficient_;
  std::int32_t place_ = 0;  // index in the table
  std::int32_t iteration_ = 0, of_round_ = 0;
  float first_ = 0.0F;   // residual at the start of the round
  float lowest_ = 0.0F;  // lowest residual since the last restart
};

}  // namespace gem
