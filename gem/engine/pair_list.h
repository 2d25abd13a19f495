// Which bodies may touch: a list of near pairs that lives for many moments, and the pairs of it that need a look now.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/contact.h"
#include "gem/engine/field_state.h"

namespace gem {

/// Finds contacts. Every result is that of testing all pairs; the list only spares work.
class PairList {
 public:
  /// Contacts of the field as it stands, ascending in (a, b).
  void find(const FieldState& f, int threads, std::vector<Contact>& contacts);
  /// Forgets the list, e.g. after a restart.
  void clear() {
    pairs_.clear();
    built_ = false;
  }
  std::int64_t builds() const { return builds_; }
  std::size_t size() const { return pairs_.size(); }

 private:
  struct Pair {
    std::int32_t a, b;
    Separation axis;
    // as they were when the pair was last looked at: a pair that was `gap` apart cannot touch before it moved so far
    Vec2 offset;
    double turned;
    double gap;
  };
  struct Box {
    Vec2 low, high;
  };

  bool still_valid(const FieldState& f, int threads) const;
  void build(const FieldState& f, int threads);
  void make_boxes(const FieldState& f, int threads);
  void fill_grid(const FieldState& f);
  void pairs_of_large_bodies(const FieldState& f);
  void pairs_of_floes(const FieldState& f, int threads);
  bool near(const FieldState& f, std::size_t a, std::size_t b) const;

  std::vector<Pair> pairs_;
  bool built_ = false;
  std::int64_t builds_ = 0;

  // when the list was built: every body was expected to go on with its velocity for `horizon_` moments
  std::vector<Vec2> position_, velocity_;
  std::vector<double> turned_;
  mutable std::int64_t age_ = 0;  // moments since
  std::int64_t horizon_ = 0;

  std::vector<Box> box_;
  Vec2 grid_origin_;
  double cell_ = 1.0;
  std::int32_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> cell_of_, cell_begin_, cell_body_;

  std::vector<std::vector<Contact>> found_;  // one per thread
  std::vector<std::vector<Pair>> near_;      // one per thread
};

}  // namespace gem
