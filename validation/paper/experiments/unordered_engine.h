// The cpu engine with sums like those of atomic additions in single precision: the impulses of contacts on a body are
// added in an order that changes from step to step. Only for the study of repeated runs.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/random.h"
#include "gem/engine/cpu/cpu_engine.h"
#include "gem/engine/step/pair_event.h"

namespace gem::repeats {

/// Start value of the sum of the impulses on a body.
enum class SumStart {
  zero,      // the sum starts at zero; the velocity takes it up in double precision
  velocity,  // the sum starts at the velocity: two impulses are enough for their order to matter
};

/// A body's velocity and spin in single precision.
struct SingleMotion {
  float x = 0.0F, y = 0.0F;  // [m/s]
  float spin = 0.0F;         // [rad/s]
};
SingleMotion operator+(SingleMotion a, SingleMotion b);

/// `start` plus the pushes in the given order.
SingleMotion sum_of(SingleMotion start, const std::vector<SingleMotion>& pushes);

/// Puts the pushes into a random order; all orders have equal probability.
void shuffle(std::vector<SingleMotion>& pushes, RandomSequence& random);

/// Differences of sums in single precision over all time steps so far. Differences are of velocity, relative to the sum
/// of the magnitudes of the terms.
struct SumStatistics {
  std::int64_t sums = 0;       // number of sums: one per pushed body and time step
  std::int64_t several = 0;    // sums with enough terms for their order to matter
  std::int64_t changed = 0;    // sums whose bits differ from those in the order of the contacts
  double order_squares = 0.0;  // against the order of the contacts, over `several`
  double order_largest = 0.0;
  double rounding_squares = 0.0;  // against the sum in double precision, over `sums`
  double rounding_largest = 0.0;
  std::int64_t platform_sums = 0;  // sums of the platform among `several`
  double platform_squares = 0.0;   // platform velocity against that in the order of the contacts [m2/s2]
};

class UnorderedEngine : public CpuEngine {
 public:
  /// `repeat` is the seed of the orders: equal repeats give equal bits.
  UnorderedEngine(const SceneDef& scene, Bodies bodies, SumStart start, std::uint64_t repeat);

  std::string method() const override { return "sums in single precision in no fixed order"; }
  const SumStatistics& statistics() const { return statistics_; }

 protected:
  void before_contact_events() override;
  void after_contact_events() override;

 private:
  struct Entry {
    std::int32_t body;
    VelocityChange push;
  };
  void keep_motions();
  void gather_pushes();
  void sum_again();
  void sum_body(std::int32_t i, const Entry* first, const Entry* last, RandomSequence& random);

  SumStart start_;
  std::uint64_t repeat_;
  std::vector<Vec2> velocity_;  // before the contact events
  std::vector<double> spin_;
  std::vector<Entry> entry_;  // sorted by body, then by contact
  std::vector<SingleMotion> pushes_;
  SumStatistics statistics_;
};

}  // namespace gem::repeats
