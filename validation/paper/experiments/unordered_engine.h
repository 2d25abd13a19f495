// The CPU engine with sums like those of atomic additions in single precision: what contacts push a body is added up in
// an order that changes from step to step. For the study of repeated runs; no run is made with it otherwise.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/random.h"
#include "gem/engine/cpu/cpu_engine.h"
#include "gem/engine/step/pair_event.h"

namespace gem::repeats {

/// What the pushes are added to, one after the other.
enum class SumStart {
  zero,      // their sum, which the velocity takes up in double precision
  velocity,  // the velocity itself: two pushes are enough for their order to matter
};

/// A body's velocity and spin in single precision.
struct SingleMotion {
  float x = 0.0F, y = 0.0F;  // [m/s]
  float spin = 0.0F;         // [rad/s]
};
SingleMotion operator+(SingleMotion a, SingleMotion b);

/// `start` and then the pushes in the order in which they stand.
SingleMotion sum_of(SingleMotion start, const std::vector<SingleMotion>& pushes);

/// Puts the pushes into an order that is one of all orders with equal chance.
void shuffle(std::vector<SingleMotion>& pushes, RandomSequence& random);

/// How far sums in single precision lay apart over all time steps so far. Differences are of velocity, relative to the
/// sum of the lengths of what was added.
struct SumStatistics {
  std::int64_t sums = 0;       // of bodies that were pushed, one a time step
  std::int64_t several = 0;    // of them with enough terms for their order to matter
  std::int64_t changed = 0;    // of them with other bits than in the order of the contacts
  double order_squares = 0.0;  // against that order, over `several`
  double order_largest = 0.0;
  double rounding_squares = 0.0;  // against the sum in double precision, over `sums`
  double rounding_largest = 0.0;
  std::int64_t platform_sums = 0;  // the platform's of `several`
  double platform_squares = 0.0;   // its velocity against the order of the contacts [m2/s2]
};

class UnorderedEngine : public CpuEngine {
 public:
  /// `repeat` is the seed of the orders: the same repeat gives the same bits.
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
  std::vector<Vec2> velocity_;  // before the events
  std::vector<double> spin_;
  std::vector<Entry> entry_;  // by body, then in the order of the contacts
  std::vector<SingleMotion> pushes_;
  SumStatistics statistics_;
};

}  // namespace gem::repeats
