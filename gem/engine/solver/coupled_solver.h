// The coupled solver on the host: all events of one time step together, iterated to a stated residual.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/pack.h"
#include "gem/engine/cpu/thread_team.h"
#include "gem/engine/engine.h"
#include "gem/engine/solver/coupled_layout.h"
#include "gem/engine/solver/coupled_point.h"
#include "gem/engine/solver/coupled_rounds.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Keeps what lasts from step to step: the impulses of the last one.
class CoupledSolver {
 public:
  /// Time steps with fewer contacts for each thread are iterated by one: the waits would cost more than the others
  /// bring.
  explicit CoupledSolver(std::size_t contacts_worth_a_thread = 256)
      : contacts_worth_a_thread_(contacts_worth_a_thread) {}

  /// Makes room for the contacts (ascending in a, b) that `threads` will resolve; asks for no velocity and no position.
  void lay_out(const FieldState& f, Contacts contacts, int threads);
  // inside a team's run: the stages of the contacts laid out
  /// Their points, as the last time step left them.
  void gather(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank);
  /// Iterates to the stated residual, or to the most iterations.
  void iterate(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank);
  /// Hands back impulses, velocities and repair shifts.
  void settle(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, StepQuality& quality);
  /// All three.
  void resolve(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, StepQuality& quality);

  const std::vector<std::uint64_t>& keys() const { return keys_; }
  const std::vector<PointImpulse<double>>& impulses() const { return impulses_; }
  void restore(std::vector<std::uint64_t> keys, std::vector<PointImpulse<double>> impulses);

 private:
  /// A point and the impulse that the base has of it.
  struct alignas(64) Point {  // two lines of the cache
    PointGeometry<double> geometry;
    PointImpulse<double> impulse;
  };
  /// What one thread works on.
  struct Stretch {
    std::int32_t first_block, last_block, first_point, last_point, first_entry, last_entry;
  };

  void make_space();
  std::size_t last_key_from(std::size_t at, std::uint64_t key) const;
  PointImpulse<double> last_impulse(std::uint64_t key, std::size_t at) const;
  void begin_points(const FieldState& f, Contacts contacts, std::int64_t begin, std::int64_t end);
  Stretch stretch_of(const ThreadTeam& team, int rank) const;
  void move_by_base(const FieldState& f, const Stretch& s);
  void keep_best_share(const FieldState& f, ThreadTeam& team, int rank, const Stretch& s, double limit);
  void begin_round(const FieldState& f, ThreadTeam& team, const Stretch& s, bool first);
  void end_round(const FieldState& f, const Stretch& s);
  void iterate(const FieldState& f, ThreadTeam& team, int rank);
  void hand_back(FieldState& f, Contacts contacts, ThreadTeam& team, int rank);

  std::vector<std::uint64_t> keys_;
  std::vector<PointImpulse<double>> impulses_;
  std::vector<std::uint64_t> next_keys_;  // of this time step, while the last one's are still read
  std::vector<PointImpulse<double>> next_impulses_;

  CoupledLayout layout_;
  CoupledRounds rounds_;
  std::vector<Point> point_;
  std::vector<Motion<double>> motion_;    // per entry: under the base's impulses
  std::vector<double> given_, answered_;  // per entry by rank: impulse on its velocity before, and on its change [J]
  double share_ = 1.0;

  struct alignas(64) Asked {  // one per thread
    float speed = 0.0F;
  };
  std::vector<Asked> asked_;
  std::int32_t iterations_ = 0;
  double residual_ = 0.0;
  ThreadTeam alone_{1};
  std::size_t contacts_worth_a_thread_;
};

}  // namespace gem
