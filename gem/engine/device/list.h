// Builds the list of near pairs and the rows of all bodies. Rows are sorted. The memory that a row or pair gets may
// differ from run to run; no result depends on it.
//
// Algorithm, with a barrier after each step:
//   0. put aside the narrow-phase results of the pairs of the last list
//   1. take the path and box of every body, and the extremes of the floes' positions, velocities and radii
//   2. count the floes of each cell of a grid
//   3. give each row of cells a range of the array of floes
//   4. put the floes in the range of their cell
//   5. find the lower non-floes (platform, fixed bodies) near each body and, for a floe, the floes in three ranges of
//   cells; write its row
//   6. write the row of each non-floe, with the higher bodies near it; the rows of the platform's pieces stand one
//   after another
//   7. make a pair for each near body with a higher id; it keeps its narrow-phase result if it was in the last list
#pragma once

#include "gem/engine/device/grid.h"

namespace gem {

/// Takes `count` entries: for the row of body i, or for the rows of all pieces of the platform where i is 0. Returns
/// the index of the first; -1, with alarm_list_full, if the memory is too small.
template <class Group>
GEM_DEVICE inline std::int32_t take_entries(const DeviceScene& s, Group& group, std::int32_t i, std::int32_t count) {
  const std::int32_t begin = group.add(&s.counters->rows, count);
  const bool fits = begin + count <= s.rows_capacity && (i > 0 || count <= s.platform_capacity);
  if (!fits) group.raise(alarm_list_full);
  return fits ? begin : -1;
}

/// Sets the row of body i to `count` entries from `begin` on. Without memory, `begin` = -1, the row is empty.
GEM_DEVICE inline void set_row(const DeviceScene& s, std::int32_t i, std::int32_t begin, std::int32_t count,
                               std::int32_t lower) {
  const bool fits = begin >= 0;
  s.motion[i].row_begin = fits ? begin : 0;
  s.motion[i].row_count = fits ? count : 0;
  s.motion[i].lower_count = fits ? lower : 0;
}

/// Sorts a short row; work of one thread.
GEM_DEVICE inline void sort_row(std::int32_t* row, std::int32_t count) {
  for (std::int32_t k = 1; k < count; ++k) {
    const std::int32_t one = row[k];
    std::int32_t at = k;
    for (; at > 0 && row[at - 1] > one; --at) row[at] = row[at - 1];
    row[at] = one;
  }
}

/// Writes `count` unsorted ids to a row in ascending order, some by each lane. The index of an id is the number of
/// lower ones.
template <class Lanes>
GEM_DEVICE inline void write_sorted(const Lanes& lanes, std::int32_t* row, const std::int32_t* near,
                                    std::int32_t count) {
  for (std::int32_t k = lanes.rank(); k < count; k += Lanes::size) {
    const std::int32_t one = near[k];
    std::int32_t below = 0;
    for (std::int32_t j = 0; j < count; ++j) below += near[j] < one ? 1 : 0;
    row[below] = one;
  }
}

/// Step 5: a group of lanes for each body.
template <class Group>
GEM_DEVICE inline void find_near(const DeviceScene& s, Group& group, const ListGrid& grid) {
  const auto lanes = group.lanes();
  const std::int32_t lane_groups = size_of(group) / Group::Lanes::size;
  for (std::int32_t i = rank_of(group) / Group::Lanes::size; i < s.bodies; i += lane_groups) {
    std::int32_t count = 0, lower = 0;
    std::int32_t* const kept = s.near_first + i * kept_near;
    each_near(s, lanes, grid, i, [&](std::int32_t j, bool is_near) {
      const unsigned found = lanes.ballot(is_near), below = lanes.ballot(is_near && j < i);
      const std::int32_t at = count + lanes.count_below(found);
      if (is_near && at < kept_near) kept[at] = j;
      if (is_near && is_non_floe(s, j)) group.set_bit(&s.near_non_floe[j * bit_words(s) + i / 32], 1U << (i % 32));
      count += lanes.count(found);
      lower += lanes.count(below);
    });
    if (is_non_floe(s, i)) {
      if (lanes.rank() == 0) s.motion[i].lower_count = count;  // step 6 takes the row
      continue;
    }
    std::int32_t begin = 0;
    if (lanes.rank() == 0) {
      begin = take_entries(s, group, i, count);
      set_row(s, i, begin, count, lower);
    }
    begin = lanes.from(begin, 0);
    if (begin < 0) continue;
    lanes.sync();  // all lanes see what each has kept
    std::int32_t* const row = s.row_other + begin;
    if (count <= kept_near) {
      write_sorted(lanes, row, kept, count);
      continue;
    }
    std::int32_t placed = 0;
    each_near(s, lanes, grid, i, [&](std::int32_t j, bool is_near) {
      const unsigned found = lanes.ballot(is_near);
      if (is_near) row[placed + lanes.count_below(found)] = j;
      placed += lanes.count(found);
    });
    lanes.sync();
    if (lanes.rank() == 0) sort_row(row, count);
  }
}

/// The length of the row of non-floe i, by a warp.
template <class Warp>
GEM_DEVICE inline std::int32_t count_row(const DeviceScene& s, const Warp& warp, std::int32_t i) {
  const std::int32_t words = bit_words(s);
  const std::uint32_t* const bits = s.near_non_floe + i * words;
  std::int32_t count = 0;
  for (std::int32_t w = warp.rank(); w < words; w += Warp::size) count += warp.count(bits[w]);
  return s.motion[i].lower_count + warp.sum(count);
}

/// Writes the row of non-floe i, by a warp: a word of 32 bodies for each lane.
template <class Warp>
GEM_DEVICE inline void write_row(const DeviceScene& s, const Warp& warp, std::int32_t i) {
  const std::int32_t words = bit_words(s);
  const std::uint32_t* const bits = s.near_non_floe + i * words;
  std::int32_t* const row = s.row_other + s.motion[i].row_begin;
  std::int32_t placed = 0;
  for (std::int32_t j = 0; j < i && warp.rank() == 0; ++j)
    if (s.near_non_floe[j * words + i / 32] >> (i % 32) & 1U) row[placed++] = j;
  placed = s.motion[i].lower_count;
  for (std::int32_t first = 0; first < words; first += Warp::size) {
    const std::int32_t w = first + warp.rank();
    const std::uint32_t mine = w < words ? bits[w] : 0;
    std::int32_t at = placed + warp.sum_below(warp.count(mine));
    for (std::int32_t k = 0; k < 32 && mine >> k != 0; ++k)
      if (mine >> k & 1U) row[at++] = 32 * w + k;
    placed += warp.sum(warp.count(mine));
  }
}

/// Step 6: a warp for each non-floe. That of body 0 writes the rows of all pieces of the platform, one after another.
template <class Group>
GEM_DEVICE inline void rows_of_non_floes(const DeviceScene& s, Group& group) {
  const auto warp = group.warp();
  for (std::int32_t i = rank_of(group) / Group::Warp::size; i < s.non_floes; i += size_of(group) / Group::Warp::size) {
    if (i > 0 && s.constants.is_platform(i)) continue;
    const std::int32_t end = i == 0 ? s.constants.pieces : i + 1;
    std::int32_t count = 0;
    for (std::int32_t j = i; j < end; ++j) {
      const std::int32_t own = count_row(s, warp, j);
      if (warp.rank() == 0) s.motion[j].row_count = own;
      count += own;
    }
    std::int32_t begin = warp.rank() == 0 ? take_entries(s, group, i, count) : 0;
    begin = warp.from(begin, 0);
    if (i == 0 && warp.rank() == 0) {
      s.status->platform_needed = count;
      s.platform->row_begin = begin < 0 ? 0 : begin;
      s.platform->row_count = begin < 0 ? 0 : count;
    }
    for (std::int32_t j = i; j < end; ++j) {
      if (warp.rank() == 0) set_row(s, j, begin, s.motion[j].row_count, s.motion[j].lower_count);
      warp.sync();
      if (begin < 0) continue;
      write_row(s, warp, j);
      begin += s.motion[j].row_count;
    }
  }
}

/// Index of the entry of body `other` in the sorted row of `body`.
GEM_DEVICE inline std::int32_t place_in_row(const DeviceScene& s, std::int32_t body, std::int32_t other) {
  std::int32_t low = s.motion[body].row_begin, high = low + s.motion[body].row_count;
  while (high - low > 1) {
    const std::int32_t middle = low + (high - low) / 2;
    if (s.row_other[middle] > other)
      high = middle;
    else
      low = middle;
  }
  return low;
}

/// Step 0: the narrow-phase results of the pairs outlive their list.
template <class Group>
GEM_DEVICE inline void put_axes_aside(const DeviceScene& s, Group& group) {
  const std::int32_t first = rank_of(group), step = size_of(group);
  const bool complete = s.counters->complete == 1;
  for (std::int32_t i = first; i < s.bodies; i += step)
    s.last_row[i] = {s.motion[i].row_begin, complete ? s.motion[i].row_count : 0};
  if (!complete) return;
  for (std::int32_t k = first; k < s.counters->rows; k += step) {
    s.last_other[k] = s.row_other[k];
    s.last_pair[k] = s.row_pair[k];
  }
  for (std::int32_t p = first; p < s.counters->pairs; p += step) {
    const PairCell& pair = s.pair[p];
    PairAxes& last = s.last_axes[p];
    last.axes = pair.axes;
    last.offset = pair.offset;
    last.turned_a = pair.turned_a;
    last.turned_b = pair.turned_b;
  }
}

/// The last narrow-phase result of two bodies; null if the last list had no such pair.
GEM_DEVICE inline const PairAxes* last_axes(const DeviceScene& s, std::int32_t body, std::int32_t other) {
  const RowPlace row = s.last_row[body];
  std::int32_t low = 0, high = row.count;
  while (low < high) {
    const std::int32_t middle = low + (high - low) / 2;
    if (s.last_other[row.begin + middle] < other)
      low = middle + 1;
    else
      high = middle;
  }
  const bool found = low < row.count && s.last_other[row.begin + low] == other;
  return found ? s.last_axes + s.last_pair[row.begin + low] : nullptr;
}

/// Makes pair p for the entry `row` of body i.
GEM_DEVICE inline void make_pair(const DeviceScene& s, std::int32_t p, std::int32_t i, std::int32_t row) {
  const std::int32_t other = s.row_other[row], row_b = place_in_row(s, other, i);
  PairCell& pair = s.pair[p];
  pair.a = i;
  pair.b = other;
  pair.row_a = row;
  pair.row_b = row_b;
  const PairAxes* const last = last_axes(s, i, other);
  pair.axes = last ? last->axes : SeparatingAxes{};
  pair.offset = last ? last->offset : Vec2{};
  pair.turned_a = last ? last->turned_a : 0.0;
  pair.turned_b = last ? last->turned_b : 0.0;
  if (s.wake) s.wake[p] = 0.0F;
  s.row_pair[row] = s.row_pair[row_b] = p;
  if (s.memory) s.memory[p].step = PairMemory::never;
}

/// Step 7: a group of lanes for each floe. All threads share the long rows of non-floes.
template <class Group>
GEM_DEVICE inline void make_pairs(const DeviceScene& s, Group& group) {
  const auto lanes = group.lanes();
  const std::int32_t lane_groups = size_of(group) / Group::Lanes::size;
  for (std::int32_t i = s.non_floes + rank_of(group) / Group::Lanes::size; i < s.bodies; i += lane_groups) {
    const BodyMotion& motion = s.motion[i];
    const std::int32_t begin = motion.row_begin, lower = motion.lower_count, higher = motion.row_count - lower;
    if (higher == 0) continue;
    std::int32_t p = lanes.rank() == 0 ? group.add(&s.counters->pairs, higher) : 0;
    p = lanes.from(p, 0);
    for (std::int32_t k = lanes.rank(); k < higher; k += Group::Lanes::size) make_pair(s, p + k, i, begin + lower + k);
  }
  for (std::int32_t i = 0; i < s.non_floes; ++i) {
    const BodyMotion& motion = s.motion[i];
    for (std::int32_t at = motion.lower_count + rank_of(group); at < motion.row_count; at += size_of(group))
      make_pair(s, group.add(&s.counters->pairs, 1), i, motion.row_begin + at);
  }
}

/// Builds the list from the positions at the start of the time step, to last `horizon` time steps. Raises
/// alarm_list_full where the memory is too small; the status then says how much is needed.
template <class Group>
GEM_DEVICE GEM_NOINLINE inline void build_list(const DeviceScene& s, Group& group, std::int64_t step,
                                               std::int64_t horizon) {
  const bool one = rank_of(group) == 0;
  group.barrier();
  put_axes_aside(s, group);
  group.barrier();
  if (one) *s.counters = {};
  group.lower_alarms();
  group.barrier();
  note_trajectories(s, group);
  group.barrier();
  const ListGrid grid = list_grid(s, static_cast<double>(horizon) * s.constants.dt);
  count_floes(s, group, grid);
  group.barrier();
  begin_cells(s, group, grid);
  begin_bins(s, group);
  group.barrier();
  place_floes(s, group);
  group.barrier();
  find_near(s, group, grid);
  group.barrier();
  rows_of_non_floes(s, group);
  group.barrier();
  if (one) s.status->rows_needed = s.counters->rows;
  if (group.alarms() & alarm_list_full) return;
  make_pairs(s, group);
  if (one) {
    s.counters->complete = 1;
    s.status->list_step = step;
    s.status->list_valid = 1;
    ++s.status->builds;
  }
  group.barrier();
}

}  // namespace gem
