// Which bodies may touch: a list of near pairs that lives for many moments, and the pairs of it that need a look now.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/contact.h"
#include "gem/engine/field_state.h"
#include "gem/engine/thread_team.h"

namespace gem {

/// Finds contacts. Every result is that of testing all pairs; the list only spares work.
class PairList {
 public:
  /// Inside a team's run: finds the contacts of the field as it stands.
  void find(const FieldState& f, ThreadTeam& team, int rank);
  /// Contacts of the last find, ascending in (a, b); they stay until the next.
  Contacts contacts() const { return contacts_; }
  /// Forgets the list, e.g. after a restart.
  void clear() { valid_ = false; }
  std::int64_t builds() const { return builds_; }
  std::size_t size() const { return pairs_.size(); }

 private:
  struct Pair {
    std::int32_t a, b;
    SeparatingAxes axes;
    // as they were when the pair was last looked at
    Vec2 offset;
    double turned_a = 0.0, turned_b = 0.0;
  };
  struct Box {
    Vec2 low, high;
  };

  /// Looks after every body whether it strayed from the course that the list was built on.
  void check_course(const FieldState& f, ThreadTeam& team, int rank);
  void build(const FieldState& f, ThreadTeam& team, int rank);
  void note_course(const FieldState& f);
  Box box_of(const FieldState& f, std::size_t i) const;
  void fill_grid(const FieldState& f);
  void pairs_of_large_bodies(const FieldState& f);
  void pairs_of_floe(const FieldState& f, std::size_t i, std::vector<Pair>& found) const;
  bool near(const FieldState& f, std::size_t a, std::size_t b) const;

  std::vector<Pair> pairs_;
  bool valid_ = false;
  std::int64_t builds_ = 0;

  // when the list was built: every body was expected to go on with its velocity for `horizon_` moments
  std::vector<Vec2> position_, velocity_;
  std::vector<double> turned_;
  std::int64_t age_ = 0;  // moments since
  std::int64_t horizon_ = 0;

  std::vector<Box> box_;
  Vec2 grid_origin_;
  double cell_ = 1.0;
  std::int32_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> cell_of_, cell_begin_, cell_body_;

  struct alignas(64) Part {      // one per thread
    std::vector<Contact> found;  // as long as the longest moment so far
    std::size_t count = 0;       // of them found in this moment
    std::vector<Pair> near;
    bool strayed = false;
  };
  std::vector<Part> part_;
  std::vector<Contact*> contacts_;
};

}  // namespace gem
