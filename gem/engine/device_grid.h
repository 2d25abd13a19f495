// Where the bodies of a device scene stand when a list is built: courses, boxes, the grid of floes, and the order along
// the field. Steps 1 to 4 of device_list.h, and the search in the grid.
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

}  // namespace gem
