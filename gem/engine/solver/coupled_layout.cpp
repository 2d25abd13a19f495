#include "gem/engine/solver/coupled_layout.h"

#include <algorithm>
#include <utility>

namespace gem {

void CoupledLayout::count_points(const FieldState& f, Contacts contacts) {
  points_of_.assign(f.bodies.count(), 0);
  points_as_b_.assign(f.bodies.count(), 0);
  first_point_.resize(contacts.size());
  points_ = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = *contacts[c];
    first_point_[c] = points_;
    points_ += contact.count;
    points_of_[contact.a] += contact.count;
    points_of_[contact.b] += contact.count;
    points_as_b_[contact.b] += contact.count;
  }
  // the owner of the pieces of the platform has the points of all
  for (std::int32_t i = 1; i < f.constants.pieces; ++i) points_of_[0] += std::exchange(points_of_[i], 0);
}

/// Finds the moving bodies and divides bodies and points among the threads.
void CoupledLayout::share_out(const FieldState& f, int threads) {
  moving_.clear();
  std::int64_t sides = 0;  // a point counts once per moving body
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(f.bodies.count()); ++i) {
    if (points_of_[i] == 0 || !(f.bodies.inverse_mass[i] > 0.0)) continue;
    moving_.push_back(i);
    sides += points_of_[i];
  }
  first_block_.clear();
  for (std::int64_t rank = 0; rank <= threads; ++rank)
    first_block_.push_back(static_cast<std::int32_t>(blocks() * rank / threads));
  first_entry_.assign(1, 1);
  std::int64_t counted = 0;
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(moving_.size()); ++k) {
    while (counted * threads > sides * static_cast<std::int64_t>(first_entry_.size())) first_entry_.push_back(1 + k);
    counted += points_of_[moving_[k]];
  }
  first_entry_.resize(threads + 1, 1 + static_cast<std::int32_t>(moving_.size()));
}

/// Assigns entries to the moving bodies [first, last). Bodies with equal numbers of points are grouped together.
void CoupledLayout::order_stretch(std::int32_t first, std::int32_t last) {
  constexpr std::int32_t of_each = Alike::most + 1, kinds = of_each * of_each;
  const auto kind = [this](std::int32_t i) {
    const std::int32_t as_b = points_as_b_[i], as_a = points_of_[i] - as_b;
    return of_each * std::min(as_b, Alike::most) + std::min(as_a, Alike::most);
  };
  std::int32_t next[kinds + 1] = {};
  for (std::int32_t j = first; j < last; ++j) ++next[kind(moving_[j]) + 1];
  for (std::int32_t k = 0; k < kinds; ++k) {
    const std::int32_t of_kind = next[k + 1], at = 1 + first + next[k];
    if (of_kind > 0) alike_.push_back({at, at + of_kind, k / of_each, k % of_each});
    next[k + 1] += next[k];
  }
  for (std::int32_t j = first; j < last; ++j) {
    const std::int32_t at = 1 + first + next[kind(moving_[j])]++;
    body_[at] = moving_[j];
    rank_[at] = j;
  }
}

/// Orders each stretch of a thread's bodies separately, so that neighbours stay close in memory. The length of a
/// stretch was chosen by hand; it affects only speed.
void CoupledLayout::order_bodies(const FieldState& f) {
  constexpr std::int32_t stretch = 512;
  const auto count = static_cast<std::int32_t>(moving_.size());
  body_.resize(1 + count);
  rank_.resize(1 + count);
  alike_.clear();
  for (std::size_t rank = 0; rank + 1 < first_entry_.size(); ++rank) {
    const std::int32_t end = first_entry_[rank + 1] - 1;
    for (std::int32_t first = first_entry_[rank] - 1; first < end; first += stretch)
      order_stretch(first, std::min(first + stretch, end));
  }
  entry_of_.assign(f.bodies.count(), at_rest);
  begin_as_b_.assign(2, 0);
  for (std::int32_t k = 1; k <= count; ++k) {
    entry_of_[body_[k]] = k;
    begin_as_b_.push_back(begin_as_b_.back() + points_as_b_[body_[k]]);
  }
  for (std::int32_t i = 1; i < f.constants.pieces; ++i) {
    points_of_[i] = points_of_[0];
    entry_of_[i] = entry_of_[0];
  }
}

void CoupledLayout::list_points(Contacts contacts) {
  first_as_a_.assign(body_.size(), 0);
  end_as_a_.assign(body_.size(), 0);
  next_as_b_.assign(begin_as_b_.begin(), begin_as_b_.end());
  as_b_.assign(begin_as_b_.back() + prefetch_padding, 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const std::int32_t a = entry_of_[contacts[c]->a], b = entry_of_[contacts[c]->b];
    const std::int32_t end = first_point_[c] + contacts[c]->count;
    if (end_as_a_[a] == 0) first_as_a_[a] = first_point_[c];
    end_as_a_[a] = end;
    if (b == at_rest) continue;
    for (std::int32_t point = first_point_[c]; point < end; ++point)
      as_b_[next_as_b_[b]++] = static_cast<std::uint32_t>(point);
  }
}

void CoupledLayout::lay_out(const FieldState& f, Contacts contacts, int threads) {
  count_points(f, contacts);
  share_out(f, threads);
  order_bodies(f);
  list_points(contacts);
}

}  // namespace gem
