// Broad phase: a list of near pairs that lasts for many time steps, and the pairs of it that need the narrow phase now.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/cpu/thread_team.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Finds contacts. The result equals a test of all pairs; the list only saves work.
class PairList {
 public:
  // called by every thread of a team, in this order
  /// Builds a new list if the last one is out of date.
  void renew(const FieldState& f, ThreadTeam& team, int rank);
  /// Lists the pairs that may touch now.
  void choose(ThreadTeam& team, int rank);
  /// Finds the contacts among the chosen pairs.
  void find_contacts(const FieldState& f, ThreadTeam& team, int rank);
  /// renew(), choose() and find_contacts().
  void find(const FieldState& f, ThreadTeam& team, int rank);
  /// Contacts of the last search, ascending in (a, b). They stay valid until the next search.
  Contacts contacts() const { return contacts_; }
  /// Forgets the list, e.g. after a restart.
  void clear();
  std::int64_t builds() const { return builds_; }
  std::size_t size() const { return pairs_.size(); }

 private:
  /// A near pair at its last narrow phase. Tells whether the pair needs another one.
  struct Pair {
    std::int32_t a, b;
    Vec2 offset;  // of b from a at that time [m]
    // Gap beyond the contact margin, plus the rim travel of both bodies at that time [m]. The initial value makes the
    // pair due at once and fits into a float.
    double free = -1e30;
  };
  /// Where the next narrow phase of a pair starts.
  struct FollowedAxes {
    SeparatingAxes axes;
    double turned_a = 0.0, turned_b = 0.0;  // turn_travel at the last narrow phase [rad]
  };
  /// Position of a body, and how far its rim has turned in total [m].
  struct Place {
    Vec2 position;
    double rim = 0.0;
  };
  struct Box {
    Vec2 low, high;
  };
  struct alignas(64) Part {         // one per thread
    std::vector<Contact> found;     // sized for the largest time step so far
    std::size_t count = 0;          // contacts found in this time step
    std::vector<std::int32_t> due;  // as long as pairs_: first the pairs that wake, then those that are due
    std::int64_t due_count = 0;     // pairs due in this time step
    std::vector<Pair> near;
    std::vector<std::int32_t> met;  // floes whose boxes meet the box of a floe, in one row of cells
    bool strayed = false;
    double farthest = 0.0, rim = 0.0;  // farthest motion and rim travel of a body in the last time step [m]
  };

  /// Stores the position of every body, and whether a body has left the path that the list assumes.
  void note_places(const FieldState& f, ThreadTeam& team, int rank);
  /// Lists the pairs of [begin, end) that may touch now.
  void list_due(std::int64_t begin, std::int64_t end, Part& part);
  std::int64_t list_waking(std::int64_t begin, std::int64_t end, std::int32_t* waking) const;
  /// Tests this thread's share of the due pairs, whichever thread listed them.
  void find_share(const FieldState& f, const ThreadTeam& team, int rank);
  void find_among(const FieldState& f, const std::int32_t* due, std::int64_t count, Part& part);
  bool touches(const FieldState& f, std::int32_t i, Contact& contact);

  // defined in pair_list_build.cpp
  void build(const FieldState& f, ThreadTeam& team, int rank);
  void note_trajectory(const FieldState& f);
  Box box_of(const FieldState& f, std::size_t i) const;
  Box swept(std::size_t i) const;
  void fill_grid(const FieldState& f);
  void pairs_of_non_floes(const FieldState& f);
  void pairs_of_floe(std::size_t i, Part& part) const;
  bool near(std::size_t a, std::size_t b) const;
  void keep_axes();

  std::vector<Place> place_;
  std::vector<Pair> pairs_;
  std::vector<FollowedAxes> axes_;  // per pair
  std::vector<float> wake_;         // per pair: not due while clock_ is below this [m]
  double clock_ = 0.0;              // bound on the relative motion of any two bodies since the list was built [m]
  std::vector<Pair> last_pairs_;
  std::vector<FollowedAxes> last_axes_;  // of the previous list, while the next one is built
  bool valid_ = false;
  std::int64_t builds_ = 0;

  // State when the list was built. It assumes constant velocities for `horizon_` time steps.
  std::vector<Place> trajectory_;
  std::vector<Vec2> velocity_;
  std::int64_t age_ = 0;  // time steps since the list was built
  std::int64_t horizon_ = 0;

  std::vector<Box> box_;
  double margin_ = 0.0, ahead_ = 0.0;  // margin [m], duration of the horizon [s]
  Vec2 grid_origin_, mean_velocity_;
  double cell_ = 1.0;
  std::int32_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> cell_of_, cell_begin_, cell_body_;
  std::vector<Box> cell_box_;  // swept boxes of cell_body_

  std::vector<Part> part_;
  std::vector<Contact*> contacts_;
};

}  // namespace gem
