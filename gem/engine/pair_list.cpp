// Algorithm:
//   a pair enters the list if it comes closer than the margin within the horizon, should both bodies keep their
//   velocity the list is good as long as no body has strayed from that course by more than half the margin a listed
//   pair is skipped while it has not moved, relative to itself, by the gap it had when last looked at
#include "gem/engine/pair_list.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/engine/contact_stages.h"

namespace gem {
namespace {

bool large(const FieldState& f, std::size_t i) { return f.bodies.kind[i] != BodyKind::floe; }

}  // namespace

bool PairList::still_valid(const FieldState& f, int threads) const {
  if (!built_ || age_ >= horizon_) return false;
  const double allowed = 0.5 * f.constants.list_margin;
  const double elapsed = static_cast<double>(age_) * f.constants.dt;
  const std::int64_t n = static_cast<std::int64_t>(f.bodies.count());
  int strayed = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(| : strayed)
  for (std::int64_t i = 0; i < n; ++i) {
    const Vec2 off = f.bodies.position[i] - position_[i] - elapsed * velocity_[i];
    const double left = allowed - (f.turn_travel[i] - turned_[i]);
    strayed |= (f.bodies.active[i] && !(left > 0.0 && dot(off, off) < left * left)) ? 1 : 0;
  }
  return strayed == 0;
}

void PairList::make_boxes(const FieldState& f, int threads) {
  const std::int64_t n = static_cast<std::int64_t>(f.bodies.count());
  box_.resize(n);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::int64_t i = 0; i < n; ++i) {
    const double infinity = std::numeric_limits<double>::infinity();
    Box box{{infinity, infinity}, {-infinity, -infinity}};
    for (std::int32_t v = f.bodies.vertex_begin[i]; v < f.bodies.vertex_begin[i + 1]; ++v) {
      const Vec2 p = f.bodies.position[i] + f.corner[v];
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
    box_[i] = box;
  }
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
  cell_of_.assign(n, -1);
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
      if (near(f, a, b))
        pairs_.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), {}, {}, 0.0, -1.0});
    }
  }
}

void PairList::pairs_of_floes(const FieldState& f, int threads) {
  const std::int64_t n = static_cast<std::int64_t>(f.bodies.count());
  near_.resize(threads);
  if (columns_ == 0) return;
#pragma omp parallel num_threads(threads)
  {
    std::vector<Pair>& mine = near_[omp_get_thread_num()];
    mine.clear();
    std::vector<std::int32_t> partners;
#pragma omp for schedule(static)
    for (std::int64_t i = 0; i < n; ++i) {
      if (large(f, i) || !f.bodies.active[i]) continue;
      partners.clear();
      const std::int32_t row = cell_of_[i] / columns_, column = cell_of_[i] % columns_;
      for (std::int32_t r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
        const std::int32_t first = cell_begin_[r * columns_ + std::max(column - 1, 0)];
        const std::int32_t last = cell_begin_[r * columns_ + std::min(column + 1, columns_ - 1) + 1];
        for (std::int32_t k = first; k < last; ++k)
          if (cell_body_[k] > i && near(f, i, cell_body_[k])) partners.push_back(cell_body_[k]);
      }
      std::sort(partners.begin(), partners.end());
      for (const std::int32_t b : partners) mine.push_back({static_cast<std::int32_t>(i), b, {}, {}, 0.0, -1.0});
    }
  }
  for (const std::vector<Pair>& part : near_) pairs_.insert(pairs_.end(), part.begin(), part.end());
}

void PairList::build(const FieldState& f, int threads) {
  position_ = f.bodies.position;
  velocity_ = f.bodies.velocity;
  turned_ = f.turn_travel;
  for (std::size_t i = 0; i < f.bodies.count(); ++i)
    if (large(f, i) && i > 0) velocity_[i] = {};
  const double speed = length(f.constants.current) + 1e-3;
  horizon_ =
      std::clamp<std::int64_t>(static_cast<std::int64_t>(f.constants.list_margin / (speed * f.constants.dt)), 1, 400);
  age_ = 0;
  pairs_.clear();
  make_boxes(f, threads);
  fill_grid(f);
  pairs_of_large_bodies(f);
  pairs_of_floes(f, threads);
  built_ = true;
  ++builds_;
}

void PairList::find(const FieldState& f, int threads, std::vector<Contact>& contacts) {
  if (!still_valid(f, threads)) build(f, threads);
  ++age_;
  found_.resize(threads);
  const double limit = f.constants.contact_margin;
  const std::int64_t n = static_cast<std::int64_t>(pairs_.size());
#pragma omp parallel num_threads(threads)
  {
    std::vector<Contact>& mine = found_[omp_get_thread_num()];
    mine.clear();
    Contact contact;
#pragma omp for schedule(static)
    for (std::int64_t i = 0; i < n; ++i) {
      Pair& pair = pairs_[i];
      const Vec2 offset = f.bodies.position[pair.b] - f.bodies.position[pair.a];
      const double turned = f.turn_travel[pair.a] + f.turn_travel[pair.b];
      const double left = pair.gap - limit - (turned - pair.turned);
      const Vec2 moved = offset - pair.offset;
      if (left > 0.0 && dot(moved, moved) < left * left) continue;
      if (!f.bodies.active[pair.a] || !f.bodies.active[pair.b]) continue;
      if (find_contact(f, pair.a, pair.b, pair.axis, pair.gap, contact)) mine.push_back(contact);
      pair.offset = offset;
      pair.turned = turned;
    }
  }
  contacts.clear();
  for (const std::vector<Contact>& part : found_) contacts.insert(contacts.end(), part.begin(), part.end());
}

}  // namespace gem
