// Memory layout of the bodies and points of a coupled time step.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/pack.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// Entry 0 of every per-body array never moves. It stands for fixed bodies and unused lanes.
class CoupledLayout {
 public:
  static constexpr std::int32_t at_rest = 0;
  /// A range of entries with equal numbers of points as B and as A; `most` means that number or more (chosen by hand).
  struct Alike {
    static constexpr std::int32_t most = 15;
    std::int32_t first, last, as_b, as_a;
  };
  /// Padding of points_as_b(), so that a prefetch may read past its end. The distance was chosen by hand.
  static constexpr std::int32_t prefetch_padding = 12;

  void lay_out(const FieldState& f, Contacts contacts, int threads);

  std::int32_t points() const { return points_; }
  /// Number of moving bodies with points. Their entries are 1 to bodies().
  std::int32_t bodies() const { return static_cast<std::int32_t>(body_.size()) - 1; }
  /// Blocks of eight points, and entries, of thread `rank`: its range ends where the range of the next thread begins.
  /// Bodies are placed near their points, so that little data moves between processors.
  std::int32_t first_block_of(int rank) const { return first_block_[rank]; }
  std::int32_t first_entry_of(int rank) const { return first_entry_[rank]; }
  std::int32_t blocks() const { return (points_ + float_lanes - 1) / float_lanes; }
  std::int32_t first_point(std::size_t contact) const { return first_point_[contact]; }
  /// Number of points on a body of the field.
  std::int32_t points_of(std::int32_t body) const { return points_of_[body]; }
  std::int32_t entry_of(std::int32_t body) const { return entry_of_[body]; }

  // Per entry. The points of an entry as B come before its points as A; the points as A are contiguous.
  std::int32_t body(std::int32_t entry) const { return body_[entry]; }
  /// Rank among the moving bodies with points, ascending in body id.
  std::int32_t rank(std::int32_t entry) const { return rank_[entry]; }
  std::int32_t begin_as_b(std::int32_t entry) const { return begin_as_b_[entry]; }
  std::int32_t first_as_a(std::int32_t entry) const { return first_as_a_[entry]; }
  std::int32_t end_as_a(std::int32_t entry) const { return end_as_a_[entry]; }
  const std::uint32_t* points_as_b() const { return as_b_.data(); }
  /// Groups of alike entries, ascending.
  const std::vector<Alike>& alike() const { return alike_; }

 private:
  void count_points(const FieldState& f, Contacts contacts);
  void share_out(const FieldState& f, int threads);
  void order_bodies(const FieldState& f);
  void order_stretch(std::int32_t first, std::int32_t last);
  void list_points(Contacts contacts);

  std::int32_t points_ = 0;
  std::vector<std::int32_t> first_block_, first_entry_;           // per thread, plus the end
  std::vector<std::int32_t> first_point_;                         // per contact
  std::vector<std::int32_t> points_of_, points_as_b_, entry_of_;  // per body of the field
  std::vector<std::int32_t> moving_;                              // moving bodies with points, ascending
  std::vector<std::int32_t> body_, rank_, begin_as_b_, first_as_a_, end_as_a_, next_as_b_;  // per entry
  std::vector<std::uint32_t> as_b_;
  std::vector<Alike> alike_;
};

}  // namespace gem
