// How the iterations of a coupled time step go on: how far each extrapolates, and when they end.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/macros.h"

namespace gem {

/// How far the impulses are extrapolated along their last change (Nesterov 1983), iteration by iteration: `most`
/// numbers from the beginning of a time step, then `most` from nothing. Listed, as each takes a root and two divisions.
std::vector<float> momentum_coefficients(std::int64_t most);

/// The course of a time step's iterations: how far each extrapolates, when the base is looked at again and when to
/// stop.
class IterationControl {
 public:
  enum class Next { iteration, round, end };

  /// `residual`: speed that no point may still ask for [m/s]; `most`: bound on the iterations; `tight`: the residual is
  /// below what a round in single precision can tell, so only the first visit of a round counts.
  /// `momentum_coefficients`: what carried_ahead() makes of `most`.
  GEM_HD IterationControl(double residual, std::int64_t most, bool tight, const float* momentum_coefficients)
      : residual_(residual),
        most_(static_cast<std::int32_t>(most)),
        tight_(tight),
        momentum_coefficients_(momentum_coefficients),
        next_coefficient_(momentum_coefficients[0]) {}

  GEM_HD std::int64_t iteration() const { return iteration_; }

  /// Begins an iteration: how far the impulses are extrapolated along their last change.
  GEM_HD float momentum_coefficient() {
    ++iteration_;
    ++of_round_;
    judged_ = iteration_ % 4 == 0 || iteration_ <= 2 || iteration_ == most_ || (tight_ && of_round_ == 1);
    const float now = next_coefficient_;
    // asked for an iteration ahead: on a device it waits for memory; the list ends later, as no course begins again
    // before its second iteration
    next_coefficient_ = momentum_coefficients_[++place_];
    return now;
  }

  /// Whether the residual of this iteration is looked at; a look costs two divisions a point.
  GEM_HD bool judged() const { return judged_; }

  /// What follows an iteration that left `asked`, if it was judged [m/s].
  GEM_HD Next after(float asked) {
    if (of_round_ == 1) first_ = asked;
    if (judged_) watch(asked);
    const bool met = judged_ && static_cast<double>(asked) <= residual_;
    if (iteration_ >= most_ || (met && (!tight_ || of_round_ == 1))) return Next::end;
    if (of_round_ < longest_round &&
        !(judged_ && tight_ && (met || static_cast<double>(asked) <= single_precision * static_cast<double>(first_))))
      return Next::iteration;
    of_round_ = 0;
    return Next::round;
  }

  /// Residuals below this share of the speeds need several rounds.
  static constexpr double single_precision = 1e-6;

 private:
  static constexpr std::int64_t longest_round = 32;

  /// Carries ahead from nothing again once the residual has grown well beyond the lowest.
  GEM_HD void watch(float asked) {
    constexpr float well_beyond = 2.0F;
    const bool overshot = lowest_ > 0.0F && asked > well_beyond * lowest_;
    if (overshot) {
      place_ = most_;
      next_coefficient_ = momentum_coefficients_[place_];
    }
    if (overshot || lowest_ == 0.0F || asked < lowest_) lowest_ = asked;
  }

  double residual_;
  std::int32_t most_;
  bool tight_, judged_ = false;
  const float* momentum_coefficients_;
  float next_coefficient_;
  std::int32_t place_ = 0;  // in that list
  std::int32_t iteration_ = 0, of_round_ = 0;
  float first_ = 0.0F;   // residual at the beginning of the round
  float lowest_ = 0.0F;  // since the last time that nothing was extrapolated
};

}  // namespace gem
