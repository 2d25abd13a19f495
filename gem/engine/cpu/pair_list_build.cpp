// Builds the list of near pairs: floes are sorted into cells, and each floe is tested against the neighbouring cells.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gem/engine/cpu/pair_list.h"

namespace gem {
namespace {

bool is_non_floe(const FieldState& f, std::size_t i) { return f.bodies.kind[i] != BodyKind::floe; }

}  // namespace

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

/// The area that a floe may cover within the horizon, relative to the mean drift, plus half the margin. Floes whose
/// areas do not overlap stay apart.
PairList::Box PairList::swept(std::size_t i) const {
  const Box& box = box_[i];
  const Vec2 way = ahead_ * (velocity_[i] - mean_velocity_);
  const double half = 0.5 * margin_;
  return {{box.low.x + std::min(way.x, 0.0) - half, box.low.y + std::min(way.y, 0.0) - half},
          {box.high.x + std::max(way.x, 0.0) + half, box.high.y + std::max(way.y, 0.0) + half}};
}

bool PairList::near(std::size_t a, std::size_t b) const {
  const double reach = margin_ + ahead_ * length(velocity_[b] - velocity_[a]);
  return box_[a].low.x < box_[b].high.x + reach && box_[b].low.x < box_[a].high.x + reach &&
         box_[a].low.y < box_[b].high.y + reach && box_[b].low.y < box_[a].high.y + reach;
}

void PairList::fill_grid(const FieldState& f) {
  const std::size_t n = f.bodies.count();
  const double infinity = std::numeric_limits<double>::infinity();
  Vec2 low{infinity, infinity}, high{-infinity, -infinity};
  double radius = 0.0, fastest = 0.0;
  mean_velocity_ = {};
  std::int64_t floes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (is_non_floe(f, i) || !f.bodies.active[i]) continue;
    const Vec2 p = f.bodies.position[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    radius = std::max(radius, f.bodies.radius[i]);
    mean_velocity_ += velocity_[i];
    ++floes;
  }
  columns_ = rows_ = 0;
  cell_of_.assign(n, -1);
  if (floes == 0) return;
  mean_velocity_ = (1.0 / static_cast<double>(floes)) * mean_velocity_;
  for (std::size_t i = 0; i < n; ++i)
    if (!is_non_floe(f, i) && f.bodies.active[i]) fastest = std::max(fastest, length(velocity_[i] - mean_velocity_));
  // floes that may come near each other within the horizon are in the same cell or in neighbouring cells
  cell_ = 2.0 * radius + margin_ + 2.0 * fastest * ahead_;
  // at most (4 sqrt(n) + 1)^2 cells for n floes, so that a scattered field needs no more memory than a dense one
  const double extent = std::max(high.x - low.x, high.y - low.y);
  cell_ = std::max(cell_, extent / std::sqrt(4.0 * static_cast<double>(floes)) / 2.0);
  grid_origin_ = low;
  columns_ = static_cast<std::int32_t>((high.x - low.x) / cell_) + 1;
  rows_ = static_cast<std::int32_t>((high.y - low.y) / cell_) + 1;
  cell_begin_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (is_non_floe(f, i) || !f.bodies.active[i]) continue;
    const Vec2 p = f.bodies.position[i] - low;
    cell_of_[i] = static_cast<std::int32_t>(p.y / cell_) * columns_ + static_cast<std::int32_t>(p.x / cell_);
    ++cell_begin_[cell_of_[i] + 1];
  }
  for (std::size_t c = 1; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  cell_body_.resize(floes);
  cell_box_.resize(floes);
  std::vector<std::int32_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    if (cell_of_[i] < 0) continue;
    const std::int32_t at = next[cell_of_[i]]++;
    cell_body_[at] = static_cast<std::int32_t>(i);
    cell_box_[at] = swept(i);
  }
}

void PairList::pairs_of_non_floes(const FieldState& f) {
  const std::size_t n = f.bodies.count(), pieces = static_cast<std::size_t>(f.constants.pieces);
  for (std::size_t a = 0; a < n && is_non_floe(f, a); ++a) {
    if (!f.bodies.active[a]) continue;
    for (std::size_t b = std::max(a + 1, pieces); b < n; ++b) {
      if (!f.bodies.active[b] || (f.bodies.inverse_mass[a] == 0.0 && f.bodies.inverse_mass[b] == 0.0)) continue;
      if (near(a, b)) pairs_.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), {}});
    }
  }
}

void PairList::pairs_of_floe(std::size_t i, Part& part) const {
  if (cell_of_[i] < 0) return;
  const std::size_t first_found = part.near.size();
  const Box mine = swept(i);
  const std::int32_t row = cell_of_[i] / columns_, column = cell_of_[i] % columns_;
  for (std::int32_t r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
    const std::int32_t first = cell_begin_[r * columns_ + std::max(column - 1, 0)];
    const std::int32_t last = cell_begin_[r * columns_ + std::min(column + 1, columns_ - 1) + 1];
    part.met.resize(std::max(part.met.size(), static_cast<std::size_t>(last - first)));
    std::size_t met = 0;
    for (std::int32_t k = first; k < last; ++k) {
      const Box& box = cell_box_[k];
      part.met[met] = cell_body_[k];
      met += (cell_body_[k] > static_cast<std::int32_t>(i)) & (box.low.x < mine.high.x) & (mine.low.x < box.high.x) &
             (box.low.y < mine.high.y) & (mine.low.y < box.high.y);
    }
    for (std::size_t k = 0; k < met; ++k)
      if (near(i, part.met[k])) part.near.push_back({static_cast<std::int32_t>(i), part.met[k], {}});
  }
  std::sort(part.near.begin() + static_cast<std::ptrdiff_t>(first_found), part.near.end(),
            [](const Pair& p, const Pair& q) { return p.b < q.b; });
}

void PairList::note_trajectory(const FieldState& f) {
  trajectory_ = place_;
  velocity_ = f.bodies.velocity;
  for (auto i = static_cast<std::size_t>(f.constants.pieces); i < f.bodies.count() && is_non_floe(f, i); ++i)
    velocity_[i] = {};
  horizon_ = f.constants.list_horizon;
  ahead_ = static_cast<double>(horizon_) * f.constants.dt;
  margin_ = f.constants.list_margin + f.constants.contact_margin;
  age_ = 0;
  box_.resize(f.bodies.count());
}

/// A pair of the previous list keeps its last narrow phase. Both lists ascend in (a, b).
void PairList::keep_axes() {
  axes_.assign(pairs_.size(), {});
  std::size_t at = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Pair& pair = pairs_[i];
    while (at < last_pairs_.size() && std::pair(last_pairs_[at].a, last_pairs_[at].b) < std::pair(pair.a, pair.b)) ++at;
    if (at == last_pairs_.size() || last_pairs_[at].a != pair.a || last_pairs_[at].b != pair.b) continue;
    pairs_[i] = last_pairs_[at];
    axes_[i] = last_axes_[at];
  }
}

void PairList::build(const FieldState& f, ThreadTeam& team, int rank) {
  const std::int64_t n = static_cast<std::int64_t>(f.bodies.count());
  team.single(rank, [&] { note_trajectory(f); });
  team.for_each(rank, n, [&](std::int64_t i) { box_[i] = box_of(f, i); });
  team.single(rank, [&] {
    last_pairs_.swap(pairs_);
    last_axes_.swap(axes_);
    pairs_.clear();
    fill_grid(f);
    pairs_of_non_floes(f);
  });
  part_[rank].near.clear();
  team.for_each(rank, n, [&](std::int64_t i) { pairs_of_floe(i, part_[rank]); });
  team.single(rank, [&] {
    for (int r = 0; r < team.size(); ++r) pairs_.insert(pairs_.end(), part_[r].near.begin(), part_[r].near.end());
    keep_axes();
    wake_.assign(pairs_.size(), 0.0F);
    clock_ = 0.0;
    valid_ = true;
    ++builds_;
  });
}

}  // namespace gem
