// The coupled solver on the host: all events of one time step together, iterated to the residual of the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/pack.h"
#include "gem/engine/cpu/thread_team.h"
#include "gem/engine/engine.h"
#include "gem/engine/solver/coupled_layout.h"
#include "gem/engine/solver/coupled_point.h"
#include "gem/engine/solver/coupled_rounds.h"
#include "gem/engine/solver/splitting/islands.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Keeps the impulses of the last time step as a warm start.
class CoupledSolver {
 public:
  /// Time steps with fewer contacts per thread are iterated by one thread, since barriers would cost more than the
  /// other threads save.
  explicit CoupledSolver(std::size_t contacts_worth_a_thread = EngineOptions{}.contacts_worth_a_thread)
      : contacts_worth_a_thread_(contacts_worth_a_thread) {}

  /// Allocates memory for the contacts (ascending in a, b) and divides them among `threads`. Reads no velocity and no
  /// position.
  void lay_out(const FieldState& f, Contacts contacts, int threads);
  // stages, called by every thread of a team
  /// Prepares the points of the contacts and their warm start.
  void gather(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank);
  /// Iterates to the residual of the scene or to its largest number of iterations.
  void iterate(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank);
  /// Writes the impulses to the contacts, and velocities and repair shifts to the bodies.
  void settle(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, StepQuality& quality);
  /// gather(), iterate() and settle().
  void resolve(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, StepQuality& quality);

  const std::vector<std::uint64_t>& keys() const { return keys_; }
  const std::vector<PointMemory>& memory() const { return memory_; }
  void restore(std::vector<std::uint64_t> keys, std::vector<PointMemory> memory);

 private:
  /// A point and its impulse in the base.
  struct alignas(64) Point {  // two cache lines
    PointGeometry<double> geometry;
    PointImpulse<double> impulse;
  };
  /// The ranges that one thread works on.
  struct Stretch {
    std::int32_t first_block, last_block, first_point, last_point, first_entry, last_entry;
  };

  void make_space(Iteration iteration);
  std::size_t last_key_from(std::size_t at, std::uint64_t key) const;
  PointMemory memory_of(std::uint64_t key, std::size_t at) const;
  void begin_points(const FieldState& f, Contacts contacts, std::int64_t begin, std::int64_t end);
  Stretch stretch_of(const ThreadTeam& team, int rank) const;
  void move_by_base(const FieldState& f, const Stretch& s);
  void keep_best_share(const FieldState& f, ThreadTeam& team, int rank, const Stretch& s, double limit);
  void begin_round(const FieldState& f, ThreadTeam& team, const Stretch& s, bool first);
  void end_round(const FieldState& f, const Stretch& s);
  void iterate_with(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank);
  void iterate_gradient(const FieldState& f, ThreadTeam& team, int rank);
  void iterate_splitting(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank);
  void hand_to_islands(const FieldState& f, Contacts contacts, int threads);
  void hand_back(FieldState& f, Contacts contacts, ThreadTeam& team, int rank);

  std::vector<std::uint64_t> keys_;
  std::vector<PointMemory> memory_;
  std::vector<std::uint64_t> next_keys_;  // of this time step, while those of the last step are still read
  std::vector<PointMemory> next_memory_;

  CoupledLayout layout_;
  CoupledRounds rounds_;
  Islands islands_;
  std::vector<Point> point_;
  std::vector<SpareFriction> spare_;                      // per point
  std::vector<Motion<double>> motion_;                    // per entry: motion after the impulses of the base
  std::vector<double> linear_energy_, quadratic_energy_;  // per rank of an entry: see EnergyChange [J]
  double share_ = 1.0;

  struct alignas(64) ThreadResidual {  // one cache line per thread
    float speed = 0.0F;
  };
  std::vector<ThreadResidual> thread_residual_;
  std::int32_t iterations_ = 0;
  double residual_ = 0.0;
  ThreadTeam alone_{1};
  std::size_t contacts_worth_a_thread_;
};

}  // namespace gem
