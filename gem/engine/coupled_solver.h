// The coupled resolution on the host: all events of one moment together, swept by colour to a stated residual.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/contact.h"
#include "gem/engine/engine.h"
#include "gem/engine/field_state.h"
#include "gem/engine/thread_team.h"

namespace gem {

/// Keeps what lasts from moment to moment: the impulses of the last one.
class CoupledSolver {
 public:
  /// Moments with fewer contacts are swept by one thread: the wait after each colour would cost more than it brings.
  explicit CoupledSolver(std::size_t contacts_worth_threads = 2048) : contacts_worth_threads_(contacts_worth_threads) {}

  /// Inside a team's run: resolves the contacts (ascending in a, b); changes velocities, impulses and repair shifts.
  void resolve(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, MomentQuality& quality);

  const std::vector<std::uint64_t>& keys() const { return keys_; }
  const std::vector<Vec2>& impulses() const { return impulses_; }
  void restore(std::vector<std::uint64_t> keys, std::vector<Vec2> impulses);
  /// Colour of each contact of the last moment: contacts of one colour share no moving body.
  const std::vector<std::uint8_t>& colours() const { return colour_of_; }

 private:
  void warm_start(Contacts contacts) const;
  void keep(Contacts contacts);
  void colour(const FieldState& f, Contacts contacts);
  void sweep_to_residual(FieldState& f, Contacts contacts, ThreadTeam& team, int rank);
  void start_moment(FieldState& f, Contacts contacts);
  void end_sweep(FieldState& f, Contacts contacts);

  /// Calls visit(contact) for all contacts, a colour at a time.
  template <class Visit>
  void sweep(ThreadTeam& team, int rank, Visit&& visit);

  std::vector<std::uint64_t> keys_;
  std::vector<Vec2> impulses_;              // normal, tangential
  std::vector<std::uint64_t> used_;         // per body: colours taken
  std::vector<Contact*> order_;             // contacts, colour by colour
  std::vector<std::int32_t> colour_begin_;  // into order_
  std::vector<std::uint8_t> colour_of_;

  struct alignas(64) Change {  // one per thread
    double speed = 0.0;
  };
  std::vector<Change> change_;
  Vec2 platform_velocity_;  // before the moment's events
  double platform_spin_ = 0.0;
  std::int32_t sweeps_ = 0;
  double residual_ = 0.0;
  bool all_ = true;  // the next sweep visits every contact
  bool done_ = false;
  ThreadTeam alone_{1};
  std::size_t contacts_worth_threads_;
};

}  // namespace gem
