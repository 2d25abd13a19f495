// Algorithm:
//
// - A pair enters the list if it comes closer than the margin within the horizon, should both bodies keep their
// velocity.
//
// - The list is good as long as no body has strayed from that course by more than half the margin.
//
// - A listed pair is skipped while its bodies have not moved, one relative to the other, by the gap they had when last
// looked at; else its separating axes are followed from that look on.
#include "gem/engine/pair_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/engine/contact_stages.h"

namespace gem {
namespace {

bool large(const FieldState& f, std::size_t i) { return f.bodies.kind[i] != BodyKind::floe; }

}  // namespace

void PairList::check_course(const FieldState& f, ThreadTeam& team, int rank) {
  const double allowed = 0.5 * f.constants.list_margin;
  const double elapsed = static_cast<double>(age_) * f.constants.dt;
  const std::int64_t n = static_cast<std::int64_t>(f.bodies.count());
  bool strayed = false;
  for (std::int64_t i = team.begin_of(rank, n); i < team.begin_of(rank + 1, n); ++i) {
    const Vec2 off = f.bodies.position[i] - position_[i] - elapsed * velocity_[i];
    const double left = allowed - f.bodies.radius[i] * (f.turn_travel[i] - turned_[i]);
    strayed |= f.bodies.active[i] && !(left > 0.0 && dot(off, off) < left * left);
  }
  part_[rank].strayed = strayed;
}

PairList::Box PairList::box_of(const FieldState& f, std::size_t i) const {
  const double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity}, {-infinity, -infinity}};
  for (std::int32_t v = f.bodies.vertex_begin[i]; v < f.bodies.vertex_begin[i + 1]; ++v) {
    const Vec2 p = f.bodies.position[i] + f.corner[v];
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

bool PairList::near(const FieldState& f, std::size_t a, std::size_t b) const {
  const Vec2 relative = velocity_[b] - velocity_[a];
  const double reach = f.constants.list_margin + f.constants.contact_margin +
                       static_cast<double>(horizon_) * f.constants.dt * length(relative);
  return box_[a].low.x < box_[b].high.x + reach && box_[b].low.x < box_[a].high.x + reach &&
         box_[a].low.y < box_[b].high.y + reach && box_[b].low.y < box_[a].high.y + reach;
}

void PairList::fill_grid(const FieldState& f) {
  const std::size_t n = f.bodies.count();
  const double infinity = std::numeric_limits<double>::infinity();
  Vec2 low{infinity, infinity}, high{-infinity, -infinity};
  double radius = 0.0, fastest = 0.0;
  Vec2 mean;
  std::int64_t floes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (large(f, i) || !f.bodies.active[i]) continue;
    const Vec2 p = f.bodies.position[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    radius = std::max(radius, f.bodies.radius[i]);
    mean += velocity_[i];
    ++floes;
  }
  columns_ = rows_ = 0;
  cell_of_.assign(n, -1);
  if (floes == 0) return;
  mean = (1.0 / static_cast<double>(floes)) * mean;
  for (std::size_t i = 0; i < n; ++i)
    if (!large(f, i) && f.bodies.active[i]) fastest = std::max(fastest, length(velocity_[i] - mean));
  // two floes that may come near within the horizon stand in the same or in neighbouring cells
  cell_ = 2.0 * radius + f.constants.list_margin + f.constants.contact_margin +
          2.0 * fastest * static_cast<double>(horizon_) * f.constants.dt;
  // no finer than the floes are many, so that a scattered field costs no more memory than a dense one
  const double extent = std::max(high.x - low.x, high.y - low.y);
  cell_ = std::max(cell_, extent / std::sqrt(4.0 * static_cast<double>(floes)) / 2.0);
  grid_origin_ = low;
  columns_ = static_cast<std::int32_t>((high.x - low.x) / cell_) + 1;
  rows_ = static_cast<std::int32_t>((high.y - low.y) / cell_) + 1;
  cell_begin_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (large(f, i) || !f.bodies.active[i]) continue;
    const Vec2 p = f.bodies.position[i] - low;
    cell_of_[i] = static_cast<std::int32_t>(p.y / cell_) * columns_ + static_cast<std::int32_t>(p.x / cell_);
    ++cell_begin_[cell_of_[i] + 1];
  }
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  cell_body_.resize(floes);
  std::vector<std::int32_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  for (std::size_t i = 0; i < n; ++i)
    if (cell_of_[i] >= 0) cell_body_[next[cell_of_[i]]++] = static_cast<std::int32_t>(i);
}

void PairList::pairs_of_large_bodies(const FieldState& f) {
  const std::size_t n = f.bodies.count();
  for (std::size_t a = 0; a < n && large(f, a); ++a) {
    if (!f.bodies.active[a]) continue;
    for (std::size_t b = a + 1; b < n; ++b) {
      if (!f.bodies.active[b] || (f.bodies.inverse_mass[a] == 0.0 && f.bodies.inverse_mass[b] == 0.0)) continue;
      if (near(f, a, b)) pairs_.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), {}, {}, 0.0});
    }
  }
}

void PairList::pairs_of_floe(const FieldState& f, std::size_t i, std::vector<Pair>& found) const {
  if (cell_of_[i] < 0) return;
  const std::size_t first_found = found.size();
  const std::int32_t row = cell_of_[i] / columns_, column = cell_of_[i] % columns_;
  for (std::int32_t r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
    const std::int32_t first = cell_begin_[r * columns_ + std::max(column - 1, 0)];
    const std::int32_t last = cell_begin_[r * columns_ + std::min(column + 1, columns_ - 1) + 1];
    for (std::int32_t k = first; k < last; ++k) {
      const std::int32_t b = cell_body_[k];
      if (b > static_cast<std::int32_t>(i) && near(f, i, b))
        found.push_back({static_cast<std::int32_t>(i), b, {}, {}, 0.0, 0.0});
    }
  }
  std::sort(found.begin() + static_cast<std::ptrdiff_t>(first_found), found.end(),
            [](const Pair& p, const Pair& q) { return p.b < q.b; });
}

void PairList::note_course(const FieldState& f) {
  position_ = f.bodies.position;
  velocity_ = f.bodies.velocity;
  turned_ = f.turn_travel;
  for (std::size_t i = 1; i < f.bodies.count() && large(f, i); ++i) velocity_[i] = {};
  const double speed = length(f.constants.current) + 1e-3;
  horizon_ =
      std::clamp<std::int64_t>(static_cast<std::int64_t>(f.constants.list_margin / (speed * f.constants.dt)), 1, 400);
  age_ = 0;
  box_.resize(f.bodies.count());
}

void PairList::build(const FieldState& f, ThreadTeam& team, int rank) {
  const std::int64_t n = static_cast<std::int64_t>(f.bodies.count());
  team.single(rank, [&] { note_course(f); });
  team.for_each(rank, n, [&](std::int64_t i) { box_[i] = box_of(f, i); });
  team.single(rank, [&] {
    pairs_.clear();
    fill_grid(f);
    pairs_of_large_bodies(f);
  });
  part_[rank].near.clear();
  team.for_each(rank, n, [&](std::int64_t i) { pairs_of_floe(f, i, part_[rank].near); });
  team.single(rank, [&] {
    for (int r = 0; r < team.size(); ++r) pairs_.insert(pairs_.end(), part_[r].near.begin(), part_[r].near.end());
    valid_ = true;
    ++builds_;
  });
}

void PairList::find(const FieldState& f, ThreadTeam& team, int rank) {
  team.single(rank, [&] {
    part_.resize(std::max(part_.size(), static_cast<std::size_t>(team.size())));
    valid_ = valid_ && age_ < horizon_;
  });
  if (valid_) {
    check_course(f, team, rank);
    team.barrier();
    team.single(rank, [&] {
      for (int r = 0; r < team.size(); ++r) valid_ = valid_ && !part_[r].strayed;
    });
  }
  if (!valid_) build(f, team, rank);

  Part& mine = part_[rank];
  mine.count = 0;
  const double limit = f.constants.contact_margin;
  const auto pair_count = static_cast<std::int64_t>(pairs_.size());
  team.for_each(rank, pair_count, [&](std::int64_t i) {
    Pair& pair = pairs_[i];
    foresee_search(f, pairs_[std::min(i + 12, pair_count - 1)].b);
    foresee_outline(f, pairs_[std::min(i + 6, pair_count - 1)].b);
    const Vec2 offset = f.bodies.position[pair.b] - f.bodies.position[pair.a];
    const double turned_a = f.turn_travel[pair.a] - pair.turned_a, turned_b = f.turn_travel[pair.b] - pair.turned_b;
    const double radius_a = f.bodies.radius[pair.a], radius_b = f.bodies.radius[pair.b];
    const double left = pair.axes.first.distance - limit - rounding - (radius_a * turned_a + radius_b * turned_b);
    const Vec2 shifted = offset - pair.offset;
    if (left > 0.0 && dot(shifted, shifted) < left * left) return;
    if (!f.bodies.active[pair.a] || !f.bodies.active[pair.b]) return;
    if (mine.count == mine.found.size()) mine.found.resize(2 * mine.count + 64);
    // an axis turns with its body and sweeps over the other, whose far side is this far from it
    const double far = 2.0 * (radius_a + radius_b) + length(shifted) + limit;
    const double moved = length(shifted) + far * (turned_a + turned_b);
    if (find_contact(f, pair.a, pair.b, pair.axes, moved, mine.found[mine.count])) ++mine.count;
    pair.offset = offset;
    pair.turned_a = f.turn_travel[pair.a];
    pair.turned_b = f.turn_travel[pair.b];
  });
  team.single(rank, [&] {
    ++age_;
    std::size_t count = 0;
    for (int r = 0; r < team.size(); ++r) count += part_[r].count;
    contacts_.resize(count);
  });
  std::size_t at = 0;
  for (int r = 0; r < rank; ++r) at += part_[r].count;
  for (std::size_t i = 0; i < mine.count; ++i) contacts_[at + i] = &mine.found[i];
  team.barrier();
}

}  // namespace gem
