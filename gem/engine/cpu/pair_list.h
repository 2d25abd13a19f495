// Which bodies may touch: a list of near pairs that lives for many time steps, and the pairs of it that need a look
// now.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/cpu/thread_team.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Finds contacts. Every result is that of testing all pairs; the list only spares work.
class PairList {
 public:
  // inside a team's run, in this order
  /// Builds a new list where the last one has worn out.
  void renew(const FieldState& f, ThreadTeam& team, int rank);
  /// Lists the pairs that may touch now.
  void choose(ThreadTeam& team, int rank);
  /// Finds the contacts among these.
  void find_contacts(const FieldState& f, ThreadTeam& team, int rank);
  /// All three.
  void find(const FieldState& f, ThreadTeam& team, int rank);
  /// Contacts of the last find, ascending in (a, b); they stay until the next.
  Contacts contacts() const { return contacts_; }
  /// Forgets the list, e.g. after a restart.
  void clear();
  std::int64_t builds() const { return builds_; }
  std::size_t size() const { return pairs_.size(); }

 private:
  /// What tells whether a pair needs a look: as it was when last looked at.
  struct Pair {
    std::int32_t a, b;
    Vec2 offset;
    // gap beyond the contact margin, and the ways of both rims until then; at first too small not to be looked at, and
    // within what a float holds [m]
    double free = -1e30;
  };
  /// What a look starts from.
  struct FollowedAxes {
    SeparatingAxes axes;
    double turned_a = 0.0, turned_b = 0.0;  // turn_travel at the last look [rad]
  };
  /// Where a body stands and how far its rim has turned in all [m].
  struct Place {
    Vec2 position;
    double rim = 0.0;
  };
  struct Box {
    Vec2 low, high;
  };
  struct alignas(64) Part {         // one per thread
    std::vector<Contact> found;     // as long as the longest time step so far
    std::size_t count = 0;          // of them found in this time step
    std::vector<std::int32_t> due;  // room for all pairs: first those that wake, then those of them that are due
    std::int64_t due_count = 0;     // of them due in this time step
    std::vector<Pair> near;
    std::vector<std::int32_t> met;  // floes that a box meets in a row of cells
    bool strayed = false;
    double farthest = 0.0, rim = 0.0;  // that a body went and turned in the last time step [m]
  };

  /// Notes where every body stands, and whether it strayed from the course that the list was built on.
  void note_places(const FieldState& f, ThreadTeam& team, int rank);
  /// Lists those of a stretch of pairs that may touch now.
  void list_due(std::int64_t begin, std::int64_t end, Part& part);
  std::int64_t list_waking(std::int64_t begin, std::int64_t end, std::int32_t* waking) const;
  /// Takes a thread's share of the looks that are due, of whoever listed them.
  void find_share(const FieldState& f, const ThreadTeam& team, int rank);
  void find_among(const FieldState& f, const std::int32_t* due, std::int64_t count, Part& part);
  bool touches(const FieldState& f, std::int32_t i, Contact& contact);

  // pair_list_build.cpp
  void build(const FieldState& f, ThreadTeam& team, int rank);
  void note_trajectory(const FieldState& f);
  Box box_of(const FieldState& f, std::size_t i) const;
  Box swept(std::size_t i) const;
  void fill_grid(const FieldState& f);
  void pairs_of_large_bodies(const FieldState& f);
  void pairs_of_floe(std::size_t i, Part& part) const;
  bool near(std::size_t a, std::size_t b) const;
  void keep_axes();

  std::vector<Place> place_;
  std::vector<Pair> pairs_;
  std::vector<FollowedAxes> axes_;  // per pair
  std::vector<float> wake_;         // per pair: it is not due while clock_ stays below [m]
  double clock_ = 0.0;  // how far any two bodies can have gone, one relative to the other, since the list was built [m]
  std::vector<Pair> last_pairs_;
  std::vector<FollowedAxes> last_axes_;  // of the list before, while the next is built
  bool valid_ = false;
  std::int64_t builds_ = 0;

  // when the list was built: every body was expected to go on with its velocity for `horizon_` time steps
  std::vector<Place> trajectory_;
  std::vector<Vec2> velocity_;
  std::int64_t age_ = 0;  // time steps since
  std::int64_t horizon_ = 0;

  std::vector<Box> box_;
  double margin_ = 0.0, ahead_ = 0.0;  // [m], [s]
  Vec2 grid_origin_, mean_velocity_;
  double cell_ = 1.0;
  std::int32_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> cell_of_, cell_begin_, cell_body_;
  std::vector<Box> cell_box_;  // of cell_body_: swept

  std::vector<Part> part_;
  std::vector<Contact*> contacts_;
};

}  // namespace gem
