// The positions of bodies when a list is built: assumed paths, boxes, the grid of floes, and the order along the field.
// Steps 1 to 4 of list.h, and the search in the grid.
#pragma once

#include "gem/engine/device/workspace.h"

namespace gem {

/// Maps a number to an integer above 0 with the same order. Integer maxima do not depend on the order of threads.
GEM_DEVICE inline std::uint64_t to_ordered_key(double x) {
  const std::uint64_t bits = strict::bits_of(x);
  return bits >> 63 ? ~bits : bits | 0x8000000000000000U;
}
GEM_DEVICE inline double from_ordered_key(std::uint64_t key) {
  return strict::double_of(key >> 63 ? key & 0x7fffffffffffffffU : ~key);
}

/// The grid in which near floes are searched. Cells are stored row by row, with one empty cell behind each row.
struct ListGrid {
  Vec2 low;
  double cell = 1.0;
  std::int32_t columns = 0, rows = 0;
  double ahead = 0.0;  // time that the list has to last [s]
};

/// Whether body i is the platform or a fixed body. These come first, whatever their size.
GEM_DEVICE inline bool is_non_floe(const DeviceScene& s, std::int32_t i) { return i < s.non_floes; }

template <class Group>
GEM_DEVICE inline std::int32_t rank_of(const Group& group) {
  return group.block() * group.threads() + group.thread();
}
template <class Group>
GEM_DEVICE inline std::int32_t size_of(const Group& group) {
  return group.blocks() * group.threads();
}

GEM_DEVICE inline ListBox box_of(const DeviceScene& s, const BodyCell& cell) {
  ListBox box{{1e300, 1e300}, {-1e300, -1e300}};
  for (std::int32_t v = cell.vertex_begin; v < cell.vertex_begin + cell.vertex_count; ++v) {
    const Vec2 p = cell.position + rotate(cell.rotation, s.vertex[v]);
    if (p.x < box.low.x) box.low.x = p.x;
    if (p.y < box.low.y) box.low.y = p.y;
    if (p.x > box.high.x) box.high.x = p.x;
    if (p.y > box.high.y) box.high.y = p.y;
  }
  return box;
}

/// Extremes over some floes, in the order of ListCounters. Minima are stored as maxima of the opposite.
struct Extremes {
  static constexpr int count = 9;
  double most[count];
  std::int32_t floes = 0;

  GEM_DEVICE Extremes() {
    for (double& one : most) one = -1e300;
  }
  GEM_DEVICE void widen(Vec2 position, Vec2 velocity, double radius) {
    const double value[count] = {-position.x, -position.y, position.x, position.y, -velocity.x,
                                 -velocity.y, velocity.x,  velocity.y, radius};
    for (int k = 0; k < count; ++k) most[k] = larger(most[k], value[k]);
    ++floes;
  }
};

/// Enters the extremes that the threads of a warp found.
template <class Group>
GEM_DEVICE inline void note_extremes(const DeviceScene& s, Group& group, Extremes found) {
  const auto warp = group.warp();
  const int floes = warp.sum(found.floes);
  for (int k = 0; k < Extremes::count; ++k)
    for (int step = 1; step < Group::Warp::size; step *= 2)
      found.most[k] = larger(found.most[k], warp.partner(found.most[k], step));
  if (floes == 0 || warp.rank() != 0) return;
  for (int k = 0; k < Extremes::count; ++k) group.highest(&s.counters->extreme[k], to_ordered_key(found.most[k]));
  group.add(&s.counters->floes, floes);
}

GEM_DEVICE inline std::int32_t bit_words(const DeviceScene& s) { return (s.bodies + 31) / 32; }

/// Step 1. The list assumes that a body keeps its present velocity; fixed bodies stay.
template <class Group>
GEM_DEVICE inline void note_trajectories(const DeviceScene& s, Group& group) {
  const std::int32_t first = rank_of(group), step = size_of(group);
  Extremes found;
  for (std::int32_t i = first; i < s.bodies; i += step) {
    BodyCell& cell = s.body[i];
    BodyMotion& motion = s.motion[i];
    const Vec2 velocity = cell.kind == BodyKind::fixed ? Vec2{} : cell.velocity;
    motion.trajectory_position = cell.position;
    motion.trajectory_velocity = velocity;
    motion.trajectory_turned = cell.turn_travel;
    s.box[i] = box_of(s, cell);
    if (!is_non_floe(s, i) && cell.active) found.widen(cell.position, velocity, cell.radius);
  }
  note_extremes(s, group, found);
  for (std::int32_t w = first; w < s.non_floes * bit_words(s); w += step) s.near_non_floe[w] = 0;
  for (std::int32_t c = first; c < s.grid_capacity; c += step) s.grid_count[c] = 0;
  for (std::int32_t k = first; s.sorted_place && k < sort_bins; k += step) s.bin_count[k] = 0;
}

/// Index of the bin along the field that x falls in.
GEM_DEVICE inline std::int32_t bin_at(const DeviceScene& s, double x) {
  const ListCounters& all = *s.counters;
  if (all.floes == 0) return 0;
  const double low = -from_ordered_key(all.extreme[0]), extent = from_ordered_key(all.extreme[2]) - low;
  const double at = sort_bins * ((x - low) / extent);
  return at > 0.0 ? at < sort_bins - 1 ? static_cast<std::int32_t>(at) : sort_bins - 1 : 0;
}

/// Computes where each bin begins. Work of the first warp.
template <class Group>
GEM_DEVICE inline void begin_bins(const DeviceScene& s, Group& group) {
  if (!s.sorted_place || rank_of(group) >= Group::Warp::size) return;
  const auto warp = group.warp();
  std::int32_t sum = s.non_floes;
  for (std::int32_t first = 0; first < sort_bins; first += Group::Warp::size) {
    const std::int32_t k = first + warp.rank();
    const int mine = s.bin_count[k];
    s.bin_begin[k] = sum + warp.sum_below(mine);
    sum += warp.sum(mine);
  }
}

/// Puts a body in its place in the order along the field; non-floes come first.
template <class Group>
GEM_DEVICE inline void sort_body(const DeviceScene& s, Group& group, std::int32_t i) {
  if (!s.sorted_place) return;
  std::int32_t sorted_place = i;
  if (!is_non_floe(s, i)) {
    const std::int32_t bin = bin_at(s, s.body[i].position.x);
    sorted_place = s.bin_begin[bin] + group.add(&s.bin_count[bin], -1) - 1;
  }
  s.sorted_place[i] = sorted_place;
  s.body_at[sorted_place] = i;
}

/// The grid for this list. Two floes that may come near within `ahead` [s] stand in the same cell or in neighbouring
/// cells.
GEM_DEVICE inline ListGrid list_grid(const DeviceScene& s, double ahead) {
  const ListCounters& all = *s.counters;
  ListGrid grid;
  grid.ahead = ahead;
  if (all.floes == 0) return grid;
  const auto extreme = [&](int k) { return from_ordered_key(all.extreme[k]); };
  const Vec2 low{-extreme(0), -extreme(1)}, extent = Vec2{extreme(2), extreme(3)} - low;
  const Vec2 speeds{extreme(6) + extreme(4), extreme(7) + extreme(5)};
  grid.low = low;
  grid.cell = 2.0 * extreme(8) + s.constants.list_margin + s.constants.contact_margin + length(speeds) * ahead;
  // at most (4 sqrt(n) + 1)^2 cells for n floes, so that a scattered field takes no more memory than a dense one
  const double widest = extent.x > extent.y ? extent.x : extent.y;
  const double finest = widest / (4.0 * std::sqrt(static_cast<double>(all.floes)));
  if (finest > grid.cell) grid.cell = finest;
  grid.columns = static_cast<std::int32_t>(extent.x / grid.cell) + 1;
  grid.rows = static_cast<std::int32_t>(extent.y / grid.cell) + 1;
  return grid;
}

/// The centre of the range of velocities when the list was built, zero velocity included [m/s].
GEM_DEVICE inline Vec2 list_drift(const DeviceScene& s) {
  const ListCounters& all = *s.counters;
  if (all.floes == 0) return {};
  const auto middle = [&](int lowest, int highest) {
    return 0.5 *
           (smaller(-from_ordered_key(all.extreme[lowest]), 0.0) + larger(from_ordered_key(all.extreme[highest]), 0.0));
  };
  return {middle(4, 6), middle(5, 7)};
}

/// Index of a cell in the arrays of cells.
GEM_DEVICE inline std::int32_t cell_at(const ListGrid& grid, std::int32_t row, std::int32_t column) {
  return row * (grid.columns + 1) + column;
}

/// Step 3: where the floes of each cell begin. One warp for each row of cells; floes of a row are stored together.
template <class Group>
GEM_DEVICE inline void begin_cells(const DeviceScene& s, Group& group, const ListGrid& grid) {
  const auto warp = group.warp();
  const std::int32_t stride = grid.columns + 1;
  for (std::int32_t r = rank_of(group) / Group::Warp::size; r < grid.rows; r += size_of(group) / Group::Warp::size) {
    const std::int32_t* const count = s.grid_count + r * stride;
    std::int32_t* const begin = s.grid_begin + r * stride;
    std::int32_t all = 0;
    for (std::int32_t c = warp.rank(); c < grid.columns; c += Group::Warp::size) all += count[c];
    all = warp.sum(all);
    std::int32_t at = warp.rank() == 0 ? group.add(&s.counters->placed, all) : 0;
    at = warp.from(at, 0);
    for (std::int32_t first = 0; first < stride; first += Group::Warp::size) {
      const std::int32_t c = first + warp.rank();
      const std::int32_t mine = c < grid.columns ? count[c] : 0;
      const std::int32_t below = warp.sum_below(mine);
      if (c < stride) begin[c] = at + below;
      at += warp.sum(mine);
    }
  }
}

/// Step 2: counts the floes of each cell.
template <class Group>
GEM_DEVICE inline void count_floes(const DeviceScene& s, Group& group, const ListGrid& grid) {
  const std::int32_t step = size_of(group);
  for (std::int32_t i = s.non_floes + rank_of(group); i < s.bodies; i += step) {
    const BodyCell& cell = s.body[i];
    const Vec2 p = cell.position - grid.low;
    const std::int32_t at = cell.active ? cell_at(grid, static_cast<std::int32_t>(p.y / grid.cell),
                                                  static_cast<std::int32_t>(p.x / grid.cell))
                                        : -1;
    s.grid_cell[i] = at;
    if (s.sorted_place) group.add(&s.bin_count[bin_at(s, cell.position.x)], 1);
    if (at >= 0) group.add(&s.grid_count[at], 1);
  }
}

/// Step 4: puts each floe in the list of its cell.
template <class Group>
GEM_DEVICE inline void place_floes(const DeviceScene& s, Group& group) {
  const std::int32_t first = rank_of(group), step = size_of(group);
  for (std::int32_t i = first; i < s.bodies; i += step) sort_body(s, group, i);
  for (std::int32_t i = s.non_floes + first; i < s.bodies; i += step) {
    const std::int32_t at = s.grid_cell[i];
    if (at < 0) continue;
    GridFloe& floe = s.grid_floe[s.grid_begin[at] + group.add(&s.grid_count[at], -1) - 1];
    floe.box = s.box[i];
    floe.velocity = s.motion[i].trajectory_velocity;
    floe.body = i;
  }
}

/// Whether two bodies may come near within `ahead` [s].
GEM_DEVICE inline bool near(const DeviceScene& s, double ahead, const ListBox& a, Vec2 velocity_a, const ListBox& b,
                            Vec2 velocity_b) {
  const double reach = s.constants.list_margin + s.constants.contact_margin + ahead * length(velocity_b - velocity_a);
  return a.low.x < b.high.x + reach && b.low.x < a.high.x + reach && a.low.y < b.high.y + reach &&
         b.low.y < a.high.y + reach;
}

/// Calls visit(j, is_near) for the non-floes below i, and then, in no order, for the floes around body i. The lanes
/// of a group share the calls. All lanes make the same number of calls; is_near is false where a lane has no body left.
template <class Lanes, class Visit>
GEM_DEVICE inline void each_near(const DeviceScene& s, const Lanes& lanes, const ListGrid& grid, std::int32_t i,
                                 Visit&& visit) {
  const BodyCell& cell = s.body[i];
  if (!cell.active) return;
  const ListBox box = s.box[i];
  const Vec2 velocity = s.motion[i].trajectory_velocity;
  // the pieces of the platform do not meet each other
  const std::int32_t lower_non_floes = s.constants.is_platform(i) ? 0 : is_non_floe(s, i) ? i : s.non_floes;
  for (std::int32_t first = 0; first < lower_non_floes; first += Lanes::size) {
    const std::int32_t j = first + lanes.rank();
    const bool meets =
        j < lower_non_floes && s.body[j].active && (cell.inverse_mass > 0.0 || s.body[j].inverse_mass > 0.0);
    visit(j, meets && near(s, grid.ahead, s.box[j], s.motion[j].trajectory_velocity, box, velocity));
  }
  if (is_non_floe(s, i)) return;
  const std::int32_t row = s.grid_cell[i] / (grid.columns + 1), column = s.grid_cell[i] % (grid.columns + 1);
  for (std::int32_t r = row > 0 ? row - 1 : 0; r <= row + 1 && r < grid.rows; ++r) {
    const std::int32_t begin = s.grid_begin[cell_at(grid, r, column > 0 ? column - 1 : 0)],
                       end = s.grid_begin[cell_at(grid, r, column + 2 < grid.columns ? column + 2 : grid.columns)];
    for (std::int32_t first = begin; first < end; first += Lanes::size) {
      const std::int32_t at = first + lanes.rank();
      const GridFloe* const floe = s.grid_floe + at;
      const bool other = at < end && floe->body != i;
      visit(other ? floe->body : -1, other && near(s, grid.ahead, box, velocity, floe->box, floe->velocity));
    }
  }
}

}  // namespace gem
