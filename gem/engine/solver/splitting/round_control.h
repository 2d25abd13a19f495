// The course of a round of operator splitting: when the error is estimated, when the stiffness changes, when the round
// ends. The numbers were chosen in jams (bench/notebook.md, "Operator splitting", "Gradient iterations first").
#pragma once

#include <cstdint>

#include "gem/base/choose.h"

namespace gem {

/// Largest differences, as speeds [m/s]. A shift counts as its speed over one time step.
struct SplittingDifferences {
  float points = 0.0F;  // between the velocities of the points and their copies
  float bodies = 0.0F;  // between the velocities of the bodies and those that the impulses give
  float change = 0.0F;  // of the velocities that the impulses give since the last time
  float motion = 0.0F;  // of the bodies since the base
};

/// An attempt is very stiff: in effect no contact opens, closes or begins to slide, and a push crosses a chain of any
/// length in one iteration. Where many contacts change, it does not converge, and its result is dropped. A full round
/// finds which contacts change, but needs many iterations for a push through a long chain. A short round leaves the end
/// to gradient iterations.
enum class RoundKind { attempt, short_one, full };

class RoundControl {
 public:
  enum class Change { none, raise, fall };

  /// A full round that does not reach the tolerance has so many iterations, fewer at the limit of all. No round is
  /// begun if less than the shorter length is left.
  static constexpr std::int64_t longest_round = 96, shortest_round = 48;
  static constexpr std::int64_t short_round = 64;

  /// What an island goes on with after `first_kind`. `gradient`: whether gradient iterations end its rounds.
  GEM_HD static RoundKind usual_kind(bool gradient) { return gradient ? RoundKind::short_one : RoundKind::full; }
  GEM_HD static RoundKind first_kind(RoundKind usual, bool chain, std::int64_t iterations_maximum) {
    return chain && iterations_maximum >= attempt_iterations + shortest_round ? RoundKind::attempt : usual;
  }

  /// `done`: iterations of earlier rounds. `tolerance` of the velocities [m/s].
  GEM_HD RoundControl(RoundKind kind, double tolerance, std::int64_t iterations_maximum, std::int64_t done)
      : tolerance_(tolerance),
        last_(length_of(kind) < iterations_maximum - done ? length_of(kind) : iterations_maximum - done),
        low_intervals_(kind == RoundKind::full ? 2 : 1),
        scheduled_(kind != RoundKind::attempt && done < scheduled_iterations),
        stiffness_(kind == RoundKind::attempt ? attempt_stiffness
                   : scheduled_               ? first_stiffness
                                              : steady_stiffness) {}

  /// What a point asks for at the base, in parts of the tolerance, rounded up; whole numbers, so that sums have no
  /// order.
  static constexpr std::uint64_t asked_units = 1 << 20;
  GEM_HD static std::uint64_t asked(double tolerance, float speed) {
    const double share = static_cast<double>(speed) / tolerance;
    if (!(share < 1.0)) return asked_units + 1;
    return static_cast<std::uint64_t>(share * static_cast<double>(asked_units)) + (speed > 0.0F ? 1 : 0);
  }
  /// Estimate of the error of the base [m/s], from the sum of asked() over the points of an island: along a chain of
  /// bodies they add up. Four times the sum: with less, loads of run 1 were lower (bench/notebook.md).
  GEM_HD static double error_of_base(double tolerance, std::uint64_t asked) {
    return 4.0 * tolerance * static_cast<double>(asked) / static_cast<double>(asked_units);
  }

  /// Whether another round follows one that ended with `error` [m/s] after `done` iterations of all rounds.
  GEM_HD static bool goes_on(double tolerance, std::int64_t iterations_maximum, std::int64_t done, double error) {
    return iterations_maximum - done >= shortest_round && error > tolerance;
  }

  /// Over the compliance of a point.
  GEM_HD float stiffness() const { return stiffness_; }
  /// Whether points are stiffer that were made so. Not at the end of a round: the velocities of light bodies are the
  /// last to settle.
  GEM_HD bool raised() const { return stiffness_ >= first_stiffness; }
  GEM_HD std::int64_t iteration() const { return iteration_; }
  GEM_HD double error() const { return error_; }
  GEM_HD float watch_tolerance() const { return static_cast<float>(0.25 * tolerance_); }

  GEM_HD void begin_iteration() { ++iteration_; }
  /// Whether the error is estimated in this iteration.
  GEM_HD bool judged() const { return iteration_ == next_estimate_ || iteration_ == last_; }
  /// Estimates the error. Returns whether the round ends.
  GEM_HD bool ends(const SplittingDifferences& d) {
    if (iteration_ < next_estimate_) last_change_ = 0.0;  // fewer iterations than the last change had
    error_ = larger(static_cast<double>(larger(d.points, d.bodies)), still_missing(d.change, last_change_));
    error_ = larger(error_, single_precision * static_cast<double>(d.motion));
    if (first_error_ == 0.0) first_error_ = error_;
    last_change_ = d.change;
    next_estimate_ += next_estimate_ < estimate_interval ? next_estimate_ : estimate_interval;
    return iteration_ == last_ || error_ <= tolerance_ || error_ <= round_gain * first_error_;
  }
  /// What happens to the stiffness after this iteration.
  GEM_HD Change change() const {
    const std::int64_t left = last_ - iteration_;
    if (!scheduled_ || left % change_interval != 0) return Change::none;
    return left > low_intervals_ * change_interval ? Change::raise : Change::fall;
  }
  /// Notes that the stiffness changed.
  GEM_HD void changed(Change change) {
    if (change == Change::fall) stiffness_ *= fall;
    last_change_ = 0.0;
  }

 private:
  /// A round begins with a high stiffness, which soon brings the points together. It ends with a low one, which brings
  /// the impulses and the velocities of the bodies together: after `fall`, for the last two intervals, of a short round
  /// for the last one.
  static constexpr float first_stiffness = 20.0F, fall = 0.1F;
  /// The stiffness may change after so many iterations. Before it falls, points whose difference persists become
  /// stiffer.
  static constexpr std::int64_t change_interval = 16;
  /// After so many iterations the stiffness stays at one value, since rounds that repeat its course may repeat their
  /// errors.
  static constexpr std::int64_t scheduled_iterations = 4 * longest_round;
  static constexpr float steady_stiffness = 2.0F;
  static constexpr std::int64_t attempt_iterations = 8;
  static constexpr float attempt_stiffness = 2e5F;
  /// Motions within a round are good to `single_precision` of themselves. A round ends when its error has fallen by
  /// `round_gain`, which leaves a margin.
  static constexpr double round_gain = 1e-4, single_precision = 1e-6;
  /// The error is estimated after so many iterations of a round, after twice as many, and then every time so many have
  /// passed.
  static constexpr std::int64_t first_estimate = 4, estimate_interval = 8;

  /// What is still missing from a sequence that moved by `change` since the last estimate and by `last_change` before
  /// that, if it goes on by the same ratio. Without a last change (zero) the slowest ratio is taken.
  GEM_HD static double still_missing(double change, double last_change) {
    constexpr double slowest = 0.99;
    const double ratio = last_change > 0.0 ? smaller(change / last_change, slowest) : slowest;
    return change * ratio / (1.0 - ratio);
  }

  GEM_HD static std::int64_t length_of(RoundKind kind) {
    return kind == RoundKind::attempt ? attempt_iterations : kind == RoundKind::short_one ? short_round : longest_round;
  }

  double tolerance_;
  std::int64_t last_, low_intervals_;
  bool scheduled_;
  float stiffness_;
  std::int64_t iteration_ = 0, next_estimate_ = first_estimate;
  double last_change_ = 0.0, first_error_ = 0.0, error_ = 0.0;
};

}  // namespace gem
