// Where the bodies and points of a coupled time step stand in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/pack.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Entry 0 of all that is kept per body never moves: it stands for fixed bodies and unused lanes.
class CoupledLayout {
 public:
  static constexpr std::int32_t at_rest = 0;
  /// Neighbouring entries with as many points as B, and as A; `most` stands for itself and for all above.
  struct Alike {
    static constexpr std::int32_t most = 15;
    std::int32_t first, last, as_b, as_a;
  };
  /// Entries of points_as_b() past its end that may be read ahead.
  static constexpr std::int32_t foreseen = 12;

  void lay_out(const FieldState& f, Contacts contacts, int threads);

  std::int32_t points() const { return points_; }
  /// Moving bodies with points; their entries are 1 to bodies().
  std::int32_t bodies() const { return static_cast<std::int32_t>(body_.size()) - 1; }
  /// The points, in blocks of eight, and entries that thread `rank` of those laid out for works on end where the next
  /// one's begin: bodies stand with their points, so that few motions and pushes go from one processor to another.
  std::int32_t first_block_of(int rank) const { return first_block_[rank]; }
  std::int32_t first_entry_of(int rank) const { return first_entry_[rank]; }
  std::int32_t blocks() const { return (points_ + float_lanes - 1) / float_lanes; }
  std::int32_t first_point(std::size_t contact) const { return first_point_[contact]; }
  /// Points that touch a body of the field.
  std::int32_t points_of(std::int32_t body) const { return points_of_[body]; }
  std::int32_t entry_of(std::int32_t body) const { return entry_of_[body]; }

  // per entry; an entry's points as B all come before its points as A, which stand in a row
  std::int32_t body(std::int32_t entry) const { return body_[entry]; }
  /// Place among the moving bodies with points, ascending.
  std::int32_t rank(std::int32_t entry) const { return rank_[entry]; }
  std::int32_t begin_as_b(std::int32_t entry) const { return begin_as_b_[entry]; }
  std::int32_t first_as_a(std::int32_t entry) const { return first_as_a_[entry]; }
  std::int32_t end_as_a(std::int32_t entry) const { return end_as_a_[entry]; }
  const std::uint32_t* points_as_b() const { return as_b_.data(); }
  /// All moving bodies with points, ascending.
  const std::vector<Alike>& alike() const { return alike_; }

 private:
  void count_points(const FieldState& f, Contacts contacts);
  void share_out(const FieldState& f, int threads);
  void order_bodies(const FieldState& f);
  void order_stretch(std::int32_t first, std::int32_t last);
  void list_points(Contacts contacts);

  std::int32_t points_ = 0;
  std::vector<std::int32_t> first_block_, first_entry_;           // per thread, and an end
  std::vector<std::int32_t> first_point_;                         // per contact
  std::vector<std::int32_t> points_of_, points_as_b_, entry_of_;  // per body of the field
  std::vector<std::int32_t> moving_;                              // bodies that move and have points, ascending
  std::vector<std::int32_t> body_, rank_, begin_as_b_, first_as_a_, end_as_a_, next_as_b_;  // per entry
  std::vector<std::uint32_t> as_b_;
  std::vector<Alike> alike_;
};

}  // namespace gem
