// The course of the gradient iterations of an island: how far they extrapolate, when they are judged, when they end.
// The numbers were chosen in drift and jams (bench/notebook.md: "Gradient iterations first", "Plugs are no chains",
// "What stalls in a jam").
#pragma once

#include <cstdint>

#include "gem/engine/solver/splitting/island_size.h"
#include "gem/engine/solver/splitting/round_control.h"

namespace gem {

/// What the points of an island ask for in an iteration.
struct GradientAsked {
  std::uint64_t sum = 0;  // in units of GradientControl
  float largest = 0.0F;   // [m/s]
};

class GradientControl {
 public:
  enum class Next { iteration, done, give_up };

  /// `tolerance` of the velocities [m/s]. There are fewer iterations than `iterations_maximum`.
  GEM_HD GradientControl(double tolerance, std::int64_t iterations_maximum, bool jam)
      : jam_(jam),
        tolerance_(tolerance),
        last_(longest(jam) < iterations_maximum - 1 ? longest(jam) : iterations_maximum - 1),
        bound_((jam ? runaway : 16.0F) * static_cast<float>(tolerance)) {}

  GEM_HD std::int64_t iteration() const { return iteration_; }
  /// Estimate of the error after the iterations are done [m/s].
  GEM_HD double error() const { return error_; }
  /// What a point asked for at most when the iterations were last judged [m/s].
  GEM_HD double largest_asked() const { return largest_; }
  /// Whether they ran away, or met what is no number: nothing of them may stay.
  GEM_HD bool ran_away() const { return !(largest_ <= runaway * static_cast<float>(tolerance_)); }

  /// Begins an iteration. Returns how far the additions are extrapolated along their last change (Nesterov 1983).
  GEM_HD float begin_iteration() {
    const auto since = static_cast<float>(iteration_ - restarted_);
    ++iteration_;
    return since / (since + 3.0F);
  }
  /// Whether this iteration is judged. Never two in a row: a device forgets in between what the points asked for.
  GEM_HD bool judged() const { return iteration_ % judge_interval == 0; }

  /// Units for 1 m/s.
  GEM_HD float units() const { return static_cast<float>(static_cast<double>(asked_units) / tolerance_); }
  static constexpr std::uint64_t asked_units = RoundControl::asked_units;
  /// So many units are too many for any island, and no point counts more than one unit beyond.
  static constexpr std::int32_t too_many_units = static_cast<std::int32_t>(asked_units) + 1;
  /// What a point asks for [m/s], in units, rounded up; whole numbers, so that sums have no order.
  GEM_HD static std::int32_t units_of(float asked, float units_per_speed) {
    return static_cast<std::int32_t>(smaller(units_per_speed * asked, static_cast<float>(too_many_units))) +
           (asked > 0.0F ? 1 : 0);
  }

  /// Judges an iteration.
  GEM_HD Next after(const GradientAsked& asked) {
    largest_ = asked.largest;
    error_ = jam_ ? jam_margin * largest_ : RoundControl::error_of_base(tolerance_, margin * asked.sum);
    if (error_ <= tolerance_) return Next::done;
    if (iteration_ > last_ - judge_interval) return Next::give_up;
    if (iteration_ % bound_interval == 0) {
      if (!(asked.largest <= bound_)) return Next::give_up;
      if (!jam_) bound_ *= 0.25F;
    }
    // what the points ask for has grown: extrapolate from nothing, as IterationControl does
    const bool grown = lowest_ > 0.0F && asked.largest > well_beyond * lowest_;
    if (grown) restarted_ = iteration_;
    if (grown || lowest_ == 0.0F || asked.largest < lowest_) lowest_ = asked.largest;
    return Next::iteration;
  }

  static constexpr std::int64_t judge_interval = 4;
  static_assert(judge_interval > 1);

 private:
  /// What points ask for between iterations says less of the error than at rest: in a chain of a hundred floes that
  /// ended without a margin, the force at its end was off by 0.3 % (H1).
  static constexpr std::uint64_t margin = 8;
  /// In a jam a sum over thousands of points would say nothing of one of them: the largest counts, so many times.
  static constexpr double jam_margin = 4.0;
  GEM_HD static constexpr std::int64_t longest(bool jam) { return jam ? 300 : 96; }
  static constexpr float well_beyond = 2.0F;
  static constexpr float runaway = 1e6F;  // times the tolerance
  /// After so many iterations no point may ask for more than 16 times the tolerance; after as many again, for more than
  /// a quarter of that, and so on. Where they do, splitting ends sooner. In a jam, where splitting is dear, the bound
  /// is there for what is no number and for iterations that run away.
  static constexpr std::int64_t bound_interval = 16;

  bool jam_;
  double tolerance_;
  std::int64_t last_, iteration_ = 0, restarted_ = 0;
  float bound_, lowest_ = 0.0F, largest_ = 0.0F;
  double error_ = 0.0;
};

/// What gradient iterations do in an island.
struct GradientPlan {
  bool first = false;         // they come before splitting
  bool joins_rounds = false;  // splitting starts from what they reached, and they end each of its rounds
};

/// `largest_mass` [kg], `largest_inverse_mass` [1/kg] of the bodies. A floe locked among others needs the exact answer
/// of splitting (H15, R3): a small island with many points has no gradient iterations. Nor has one with a body much
/// heavier than another: what the light one still asks for says nothing of the momentum of the heavy one (H16). A jam
/// has them all the same: splitting would cost it more.
GEM_HD inline GradientPlan gradient_plan(IslandSize size, float largest_mass, float largest_inverse_mass,
                                         std::int64_t iterations_maximum) {
  constexpr float largest_mass_ratio = 1000.0F;
  const bool heavy = largest_mass * largest_inverse_mass > largest_mass_ratio;
  if (size.may_lock() || (heavy && !size.is_jam())) return {};
  if (iterations_maximum <= GradientControl::judge_interval) return {};  // it would end before it is judged
  return {true, size.is_jam()};
}

}  // namespace gem
