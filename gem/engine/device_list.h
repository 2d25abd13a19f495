// Builds the list of near pairs and the rows of all bodies. Rows are sorted; which memory a row or pair gets may differ
// from run to run, and nothing that is computed depends on it.
//
// Algorithm, a barrier after each step:
//   1. course and box of every body; extremes of the floes' positions, velocities and radii
//   2. floes counted by cell of a grid
//   3. each cell takes a stretch of the list of floes
//   4. floes placed in the stretch of their cell
//   5. each body: its lower large neighbours, and for a floe the near floes of nine cells, in a row of its own
//   6. each large body: the row of the higher bodies near it
//   7. a pair for each near body with a higher id
#pragma once

#include "gem/engine/device_desk.h"

namespace gem {

/// Whole numbers in the order of the numbers, all above 0: extremes are then taken without regard to order.
GEM_DEVICE inline std::uint64_t ordered(double x) {
  const std::uint64_t bits = strict::bits_of(x);
  return bits >> 63 ? ~bits : bits | 0x8000000000000000U;
}
GEM_DEVICE inline double unordered(std::uint64_t key) {
  return strict::double_of(key >> 63 ? key & 0x7fffffffffffffffU : ~key);
}

/// The grid on which near floes are looked for.
struct ListGrid {
  Vec2 low;
  double cell = 1.0;
  std::int32_t columns = 0, rows = 0;
};

GEM_DEVICE inline bool is_large(const DeviceScene& s, std::int32_t i) { return i < s.large_bodies; }

template <class Crew>
GEM_DEVICE inline std::int32_t rank_of(const Crew& crew) {
  return crew.block() * crew.threads() + crew.thread();
}
template <class Crew>
GEM_DEVICE inline std::int32_t size_of(const Crew& crew) {
  return crew.blocks() * crew.threads();
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

template <class Crew>
GEM_DEVICE inline void note_extremes(const DeviceScene& s, Crew& crew, const BodyCell& cell, Vec2 velocity) {
  ListCounters& all = *s.counters;
  const auto widen = [&](std::uint64_t* low, std::uint64_t* high, Vec2 value) {
    crew.highest(&low[0], ordered(-value.x));
    crew.highest(&low[1], ordered(-value.y));
    crew.highest(&high[0], ordered(value.x));
    crew.highest(&high[1], ordered(value.y));
  };
  widen(all.position_low, all.position_high, cell.position);
  widen(all.velocity_low, all.velocity_high, velocity);
  crew.highest(&all.radius, ordered(cell.radius));
  crew.add(&all.floes, 1);
}

GEM_DEVICE inline std::int32_t bit_words(const DeviceScene& s) { return (s.bodies + 31) / 32; }

/// Step 1. The course of a body is the velocity that it has now; fixed bodies stay.
template <class Crew>
GEM_DEVICE inline void note_courses(const DeviceScene& s, Crew& crew) {
  const std::int32_t first = rank_of(crew), step = size_of(crew);
  for (std::int32_t i = first; i < s.bodies; i += step) {
    BodyCell& cell = s.body[i];
    BodyMotion& motion = s.motion[i];
    const Vec2 velocity = cell.kind == BodyKind::fixed ? Vec2{} : cell.velocity;
    motion.course_position = cell.position;
    motion.course_velocity = velocity;
    motion.course_turned = cell.turn_travel;
    s.box[i] = box_of(s, cell);
    if (!is_large(s, i) && cell.active) note_extremes(s, crew, cell, velocity);
  }
  for (std::int32_t w = first; w < s.large_bodies * bit_words(s); w += step) s.near_large[w] = 0;
  for (std::int32_t c = first; c < s.grid_capacity; c += step) s.grid_count[c] = 0;
  for (std::int32_t k = first; s.spot && k < spot_stretches; k += step) s.spot_count[k] = 0;
}

/// Stretch of the field in which a floe stands.
GEM_DEVICE inline std::int32_t stretch_at(const DeviceScene& s, double x) {
  const ListCounters& all = *s.counters;
  if (all.floes == 0) return 0;
  const double low = -unordered(all.position_low[0]), extent = unordered(all.position_high[0]) - low;
  const double at = spot_stretches * ((x - low) / extent);
  return at > 0.0 ? at < spot_stretches - 1 ? static_cast<std::int32_t>(at) : spot_stretches - 1 : 0;
}

/// Where each stretch begins, by the first warp.
template <class Crew>
GEM_DEVICE inline void begin_stretches(const DeviceScene& s, Crew& crew) {
  if (!s.spot || rank_of(crew) >= Crew::Warp::size) return;
  const auto warp = crew.warp();
  std::int32_t sum = s.large_bodies;
  for (std::int32_t first = 0; first < spot_stretches; first += Crew::Warp::size) {
    const std::int32_t k = first + warp.rank();
    const int mine = s.spot_count[k];
    s.spot_begin[k] = sum + warp.sum_below(mine);
    sum += warp.sum(mine);
  }
}

/// Puts a body in its place along the field; large bodies come first.
template <class Crew>
GEM_DEVICE inline void take_spot(const DeviceScene& s, Crew& crew, std::int32_t i) {
  if (!s.spot) return;
  std::int32_t spot = i;
  if (!is_large(s, i)) {
    const std::int32_t stretch = stretch_at(s, s.body[i].position.x);
    spot = s.spot_begin[stretch] + crew.add(&s.spot_count[stretch], -1) - 1;
  }
  s.spot[i] = spot;
  s.body_at[spot] = i;
}

/// Two floes that may come near within the horizon stand in the same or in neighbouring cells.
GEM_DEVICE inline ListGrid list_grid(const DeviceScene& s) {
  const ListCounters& all = *s.counters;
  if (all.floes == 0) return {};
  const Vec2 low{-unordered(all.position_low[0]), -unordered(all.position_low[1])};
  const Vec2 extent = Vec2{unordered(all.position_high[0]), unordered(all.position_high[1])} - low;
  const Vec2 speeds{unordered(all.velocity_high[0]) + unordered(all.velocity_low[0]),
                    unordered(all.velocity_high[1]) + unordered(all.velocity_low[1])};
  ListGrid grid;
  grid.low = low;
  grid.cell = 2.0 * unordered(all.radius) + s.constants.list_margin + s.constants.contact_margin +
              length(speeds) * static_cast<double>(s.horizon) * s.constants.dt;
  // no finer than the floes are many, so that a scattered field costs no more memory than a dense one
  const double widest = extent.x > extent.y ? extent.x : extent.y;
  const double finest = widest / (4.0 * std::sqrt(static_cast<double>(all.floes)));
  if (finest > grid.cell) grid.cell = finest;
  grid.columns = static_cast<std::int32_t>(extent.x / grid.cell) + 1;
  grid.rows = static_cast<std::int32_t>(extent.y / grid.cell) + 1;
  return grid;
}

/// Steps 2 to 4.
template <class Crew>
GEM_DEVICE inline ListGrid fill_grid(const DeviceScene& s, Crew& crew) {
  const ListGrid grid = list_grid(s);
  const std::int32_t first = rank_of(crew), step = size_of(crew);
  for (std::int32_t i = s.large_bodies + first; i < s.bodies; i += step) {
    const BodyCell& cell = s.body[i];
    const Vec2 p = cell.position - grid.low;
    const std::int32_t at = cell.active ? static_cast<std::int32_t>(p.y / grid.cell) * grid.columns +
                                              static_cast<std::int32_t>(p.x / grid.cell)
                                        : -1;
    s.grid_cell[i] = at;
    if (s.spot) crew.add(&s.spot_count[stretch_at(s, cell.position.x)], 1);
    if (at >= 0) crew.add(&s.grid_count[at], 1);
  }
  crew.barrier();
  for (std::int32_t c = first; c < grid.columns * grid.rows; c += step) {
    const std::int32_t count = s.grid_count[c];
    s.grid_begin[c] = count > 0 ? crew.add(&s.counters->placed, count) : 0;
  }
  begin_stretches(s, crew);
  crew.barrier();
  for (std::int32_t i = first; i < s.bodies; i += step) take_spot(s, crew, i);
  // counted down to zero and up again: the cell's next free place
  for (std::int32_t i = s.large_bodies + first; i < s.bodies; i += step) {
    const std::int32_t at = s.grid_cell[i];
    if (at < 0) continue;
    GridFloe& floe = s.grid_floe[s.grid_begin[at] + crew.add(&s.grid_count[at], -1) - 1];
    floe.box = s.box[i];
    floe.velocity = s.motion[i].course_velocity;
    floe.body = i;
  }
  crew.barrier();
  for (std::int32_t i = s.large_bodies + first; i < s.bodies; i += step) {
    const std::int32_t at = s.grid_cell[i];
    if (at >= 0) crew.add(&s.grid_count[at], 1);
  }
  crew.barrier();
  return grid;
}

/// Whether two bodies may come near within the horizon.
GEM_DEVICE inline bool near(const DeviceScene& s, const ListBox& a, Vec2 velocity_a, const ListBox& b,
                            Vec2 velocity_b) {
  const double reach = s.constants.list_margin + s.constants.contact_margin +
                       static_cast<double>(s.horizon) * s.constants.dt * length(velocity_b - velocity_a);
  return a.low.x < b.high.x + reach && b.low.x < a.high.x + reach && a.low.y < b.high.y + reach &&
         b.low.y < a.high.y + reach;
}

/// Calls visit(j) for the lower large bodies and then, in no order, the floes near body i.
template <class Visit>
GEM_DEVICE inline void each_near(const DeviceScene& s, const ListGrid& grid, std::int32_t i, Visit&& visit) {
  const BodyCell& cell = s.body[i];
  if (!cell.active) return;
  const ListBox box = s.box[i];
  const Vec2 velocity = s.motion[i].course_velocity;
  for (std::int32_t j = 0; j < s.large_bodies && j < i; ++j) {
    const bool moves = cell.inverse_mass > 0.0 || s.body[j].inverse_mass > 0.0;
    if (s.body[j].active && moves && near(s, s.box[j], s.motion[j].course_velocity, box, velocity)) visit(j);
  }
  if (is_large(s, i)) return;
  const std::int32_t row = s.grid_cell[i] / grid.columns, column = s.grid_cell[i] % grid.columns;
  for (std::int32_t r = row - 1; r <= row + 1; ++r)
    for (std::int32_t c = column - 1; c <= column + 1; ++c) {
      if (r < 0 || r >= grid.rows || c < 0 || c >= grid.columns) continue;
      const GridFloe* floe = s.grid_floe + s.grid_begin[r * grid.columns + c];
      const GridFloe* const end = floe + s.grid_count[r * grid.columns + c];
      for (; floe != end; ++floe)
        if (floe->body != i && near(s, box, velocity, floe->box, floe->velocity)) visit(floe->body);
    }
}

/// Takes `count` places for the row of body i; false if the memory does not hold them.
template <class Crew>
GEM_DEVICE inline bool take_row(const DeviceScene& s, Crew& crew, std::int32_t i, std::int32_t count,
                                std::int32_t lower) {
  const std::int32_t begin = crew.add(&s.counters->rows, count);
  const bool fits = begin + count <= s.rows_capacity && (i > 0 || count <= s.platform_capacity);
  if (!fits) crew.raise(alarm_list_full);
  s.motion[i].row_begin = fits ? begin : 0;
  if (i == 0) s.platform->row_begin = s.motion[i].row_begin;
  s.motion[i].row_count = fits ? count : 0;
  s.motion[i].lower_count = fits ? lower : 0;
  return fits;
}

/// Places `other` in a row of `count` sorted bodies.
GEM_DEVICE inline void insert_sorted(std::int32_t* row, std::int32_t count, std::int32_t other) {
  std::int32_t at = count;
  while (at > 0 && row[at - 1] > other) {
    row[at] = row[at - 1];
    --at;
  }
  row[at] = other;
}

/// Step 5.
template <class Crew>
GEM_DEVICE inline void find_near(const DeviceScene& s, Crew& crew, const ListGrid& grid) {
  const std::int32_t first = rank_of(crew), step = size_of(crew);
  for (std::int32_t i = first; i < s.bodies; i += step) {
    std::int32_t count = 0, lower = 0;
    std::int32_t* const kept = s.near_first + i * kept_near;
    each_near(s, grid, i, [&](std::int32_t j) {
      if (count < kept_near) insert_sorted(kept, count, j);
      ++count;
      lower += j < i;
      if (is_large(s, j)) crew.set_bit(&s.near_large[j * bit_words(s) + i / 32], 1U << (i % 32));
    });
    if (is_large(s, i)) {
      s.motion[i].lower_count = count;  // step 6 takes the row
      continue;
    }
    if (!take_row(s, crew, i, count, lower)) continue;
    std::int32_t* row = s.row_other + s.motion[i].row_begin;
    std::int32_t placed = 0;
    if (count <= kept_near)
      for (; placed < count; ++placed) row[placed] = kept[placed];
    else
      each_near(s, grid, i, [&](std::int32_t j) { insert_sorted(row, placed++, j); });
  }
}

/// Step 6: a warp for each large body, a word of 32 bodies for each lane.
template <class Crew>
GEM_DEVICE inline void rows_of_large_bodies(const DeviceScene& s, Crew& crew) {
  const auto warp = crew.warp();
  const std::int32_t words = bit_words(s);
  for (std::int32_t i = rank_of(crew) / Crew::Warp::size; i < s.large_bodies; i += size_of(crew) / Crew::Warp::size) {
    const std::uint32_t* bits = s.near_large + i * words;
    const std::int32_t lower = s.motion[i].lower_count;
    std::int32_t count = 0;
    for (std::int32_t w = warp.rank(); w < words; w += Crew::Warp::size) count += warp.count(bits[w]);
    count = lower + warp.sum(count);
    if (warp.rank() == 0) {
      if (i == 0) s.status->platform_needed = count;
      take_row(s, crew, i, count, lower);
    }
    warp.sync();
    if (s.motion[i].row_count == 0) continue;
    std::int32_t* row = s.row_other + s.motion[i].row_begin;
    std::int32_t placed = 0;
    for (std::int32_t j = 0; j < i && warp.rank() == 0; ++j)
      if (s.near_large[j * words + i / 32] >> (i % 32) & 1U) row[placed++] = j;
    placed = lower;
    for (std::int32_t first = 0; first < words; first += Crew::Warp::size) {
      const std::int32_t w = first + warp.rank();
      const std::uint32_t mine = w < words ? bits[w] : 0;
      std::int32_t at = placed + warp.sum_below(warp.count(mine));
      for (std::int32_t k = 0; k < 32 && mine >> k != 0; ++k)
        if (mine >> k & 1U) row[at++] = 32 * w + k;
      placed += warp.sum(warp.count(mine));
    }
  }
}

/// Place of body `other` in the sorted row of a body.
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

/// Step 7.
template <class Crew>
GEM_DEVICE inline void make_pairs(const DeviceScene& s, Crew& crew) {
  for (std::int32_t i = rank_of(crew); i < s.bodies; i += size_of(crew)) {
    const BodyMotion& motion = s.motion[i];
    const std::int32_t higher = motion.row_count - motion.lower_count;
    if (is_large(s, i) || higher == 0) continue;
    std::int32_t p = crew.add(&s.counters->pairs, higher);
    for (std::int32_t at = motion.lower_count; at < motion.row_count; ++at, ++p) {
      const std::int32_t row = s.motion[i].row_begin + at, other = s.row_other[row];
      s.pair[p] = {i, other, row, place_in_row(s, other, i), {}, {}, 0.0, 0.0};
      s.row_pair[row] = s.row_pair[s.pair[p].row_b] = p;
      if (s.memory) s.memory[p].moment = -1;
    }
  }
  // the long rows of large bodies are shared out place by place
  for (std::int32_t i = 0; i < s.large_bodies; ++i) {
    const BodyMotion& motion = s.motion[i];
    for (std::int32_t at = motion.lower_count + rank_of(crew); at < motion.row_count; at += size_of(crew)) {
      const std::int32_t p = crew.add(&s.counters->pairs, 1);
      const std::int32_t row = s.motion[i].row_begin + at, other = s.row_other[row];
      s.pair[p] = {i, other, row, place_in_row(s, other, i), {}, {}, 0.0, 0.0};
      s.row_pair[row] = s.row_pair[s.pair[p].row_b] = p;
      if (s.memory) s.memory[p].moment = -1;
    }
  }
}

/// Builds the list at the positions of the moment's start. Raises alarm_list_full where the memory is too small; the
/// status then says how much is needed.
template <class Crew>
GEM_DEVICE inline void build_list(const DeviceScene& s, Crew& crew, std::int64_t moment) {
  const bool one = rank_of(crew) == 0;
  crew.barrier();
  if (one) *s.counters = {};
  crew.lower_alarms();
  crew.barrier();
  note_courses(s, crew);
  crew.barrier();
  const ListGrid grid = fill_grid(s, crew);
  find_near(s, crew, grid);
  crew.barrier();
  rows_of_large_bodies(s, crew);
  crew.barrier();
  if (one) s.status->rows_needed = s.counters->rows;
  if (crew.alarms() & alarm_list_full) return;
  make_pairs(s, crew);
  if (one) {
    s.status->list_moment = moment;
    s.status->list_valid = 1;
    ++s.status->builds;
  }
  crew.barrier();
}

}  // namespace gem
