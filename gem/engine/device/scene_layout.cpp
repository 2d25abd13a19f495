// Where the arrays of a device scene stand in its memory.
#include "gem/engine/device/scene_layout.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "gem/engine/device/forces.h"
#include "gem/engine/solver/device/device_solver.h"
#include "gem/engine/solver/splitting/gradient_point.h"
#include "gem/engine/solver/splitting/island_view.h"
#include "gem/engine/step/books.h"
#include "gem/field/floe_reserve.h"

namespace gem {
namespace {

/// Places arrays one after another in one memory, each aligned to 256 bytes.
class Placer {
 public:
  explicit Placer(std::byte* base) : base_(base) {}

  template <class T>
  void place(T*& array, std::size_t count) {
    array = base_ ? reinterpret_cast<T*>(base_ + used_) : nullptr;
    used_ += (count * sizeof(T) + 255) / 256 * 256;
  }
  std::size_t used() const { return used_; }

 private:
  std::byte* base_;
  std::size_t used_ = 0;
};

/// Cells of the finest grid that list_grid() may choose, with the empty one behind each row.
std::int32_t grid_cells(std::int32_t bodies) {
  const std::int32_t side = static_cast<std::int32_t>(4.0 * std::sqrt(static_cast<double>(bodies))) + 2;
  return side * side;
}

/// Other bodies of all fronts, and numbers of all factors, for each body and each halving of the scene. Fronts of
/// islands in jams need a tenth of it.
constexpr std::size_t slots_of_body = 8, numbers_of_body = 200;

void place_islands(DeviceScene& s, const SceneSizes& sizes, Placer& placer) {
  IslandMemory& m = s.island;
  const std::size_t n = sizes.bodies, points = s.points_capacity, records = s.push_capacity;
  const auto halvings = static_cast<std::size_t>(std::bit_width(n + 1));
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  const std::size_t slots = std::min(slots_of_body * n * halvings, most);
  const std::size_t numbers = std::min(numbers_of_body * n * halvings, most);
  m.slots_capacity = static_cast<std::int32_t>(slots);
  m.numbers_capacity = numbers;
  placer.place(m.counters, 1);
  placer.place(m.cell, most_island_groups);
  for (std::int32_t** array :
       {&m.joined, &m.root, &m.weight, &m.entry, &m.index, &m.rank, &m.island, &m.member, &m.place, &m.label,
        &m.next_label, &m.home, &m.order, &m.next_order, &m.side, &m.own_place, &m.parts_in, &m.first_in, &m.filled_in})
    placer.place(*array, n);
  placer.place(m.position, n);
  placer.place(m.scaled, n);
  for (FloatQuad** array : {&m.now, &m.sum, &m.solution, &m.given}) placer.place(*array, 2 * n);
  placer.place(m.records, n);
  placer.place(m.pivot, 3 * n);
  placer.place(m.share, 3 * n);
  const std::size_t trunks = records / least_large_island + 1;
  m.bodies_capacity = static_cast<std::int32_t>(n);
  placer.place(m.node, 2 * n + trunk_nodes * trunks);
  placer.place(m.level, 2 * n + 2 + trunk_levels * trunks);
  placer.place(m.forth_tile, slots);
  placer.place(m.back_tile, n);
  for (std::int32_t** array : {&m.taken_of_record, &m.point_of, &m.neighbour}) placer.place(*array, records);
  placer.place(m.push, 2 * records);
  placer.place(m.ends, points);
  placer.place(m.where, points);
  m.points_capacity = static_cast<std::int64_t>(points);
  placer.place(m.point, points * (sizeof(SplitPoint<float>) / sizeof(float)));
  placer.place(m.gradient_point, points * (sizeof(GradientPoint<float>) / sizeof(float)));
  for (std::int32_t** array : {&m.draft, &m.other, &m.front, &m.row_above, &m.unsorted, &m.sorted})
    placer.place(*array, slots);
  placer.place(m.product, 2 * slots);
  placer.place(m.numbers, numbers);
}

void place_solver(DeviceScene& s, const SceneSizes& sizes, Placer& placer) {
  const std::size_t n = sizes.bodies, rows = sizes.rows, pairs = sizes.rows / 2 + 1, blocks = sizes.blocks;
  placer.place(s.row_points, rows);
  placer.place(s.memory, pairs);
  placer.place(s.carried, pairs);
  placer.place(s.point, 2 * pairs);
  placer.place(s.point_numbers, PointTable::columns * 2 * pairs);
  s.points = {s.point_numbers, static_cast<std::int32_t>(2 * pairs)};
  placer.place(s.loaded, loaded_columns * 2 * pairs);
  placer.place(s.push, 2 * rows);
  placer.place(s.push_base, 2 * rows);
  placer.place(s.solver_entry, n);
  placer.place(s.solver_workspace, blocks);
  placer.place(s.progress, 1);
  placer.place(s.sorted_place, n);
  placer.place(s.body_at, n);
  placer.place(s.bin_count, sort_bins);
  placer.place(s.bin_begin, sort_bins);
  placer.place(s.bodies_before, blocks * ((n + 31) / 32 + 1));
  placer.place(s.sorted_before, blocks * ((n + 31) / 32 + 1));
  s.points_capacity = static_cast<std::int32_t>(2 * pairs);
  s.push_capacity = static_cast<std::int32_t>(2 * rows);
  placer.place(s.taken_point, 2 * pairs);
  placer.place(s.taken, 2 * pairs);
  placer.place(s.taken_in_row, 2 * rows);
  placer.place(s.taken_of, n);
  placer.place(s.linear_energy, n);
  placer.place(s.quadratic_energy, n);
  placer.place(s.work_created, n);
  placer.place(s.partial_sum, blocks * 4 * ((n + sum_width - 1) / sum_width + 1));
  if (sizes.splitting) place_islands(s, sizes, placer);
}

/// A scene without tables has no arrays for them.
void place_mooring(DeviceScene& s, const SceneSizes& sizes, Placer& placer) {
  if (sizes.mooring_branches == 0) return;
  placer.place(s.mooring_branch, sizes.mooring_branches);
  placer.place(s.mooring_knot, sizes.mooring_knots);
  s.constants.events.moored.view = {s.mooring_branch, s.mooring_knot, sizes.mooring_branches, sizes.mooring_knots};
}

void place_dp(DeviceScene& s, const SceneSizes& sizes, Placer& placer) {
  if (!sizes.dp) return;
  placer.place(s.dp_law, 1);
  placer.place(s.dp, 1);
  s.constants.events.dp = s.dp_law;
}

}  // namespace

SceneSizes scene_sizes(const FieldState& f) {
  const Bodies& b = f.bodies;
  SceneSizes sizes;
  sizes.bodies = static_cast<std::int32_t>(b.count());
  sizes.non_floes = static_cast<std::int32_t>(
      std::count_if(b.kind.begin(), b.kind.end(), [](BodyKind kind) { return kind != BodyKind::floe; }));
  sizes.vertices = static_cast<std::int32_t>(b.vertex.size());
  sizes.piece_corners = f.piece_corner.size();
  sizes.rows = 8 * sizes.bodies + 256;
  sizes.platform_rows = 256;
  sizes.phase_blocks = (sizes.bodies + phase_threads - 1) / phase_threads;
  sizes.coupled = f.constants.solver == ContactSolver::coupled;
  sizes.momentum_coefficients = f.momentum_coefficients.size();
  sizes.splitting = sizes.coupled && f.constants.iteration == Iteration::splitting;
  sizes.mooring_branches = f.constants.events.moored.view.branches;
  sizes.mooring_knots = f.constants.events.moored.view.knots;
  sizes.dp = f.constants.events.dp != nullptr;
  sizes.phases = !sizes.coupled || sizes.splitting || sizes.bodies <= most_cluster_bodies;
  return sizes;
}

void allow_for(const SceneDef& scene, SceneSizes& sizes) {
  sizes.vertices += static_cast<std::int32_t>(piece_corners_maximum(scene));
  if (scene.output.contact_forces) sizes.forces = ForcesWanted::last;
  if (scene.breakup.maximum_pieces > 0) sizes.forces = ForcesWanted::all;
}

std::size_t place_field(DeviceScene& s, const SceneSizes& sizes, std::byte* base) {
  Placer placer(base);
  const std::size_t n = sizes.bodies, vertices = sizes.vertices;
  placer.place(s.status, 1);
  placer.place(s.platform, 1);
  placer.place(s.state, n);
  placer.place(s.books, n * static_cast<std::size_t>(Channel::count));
  placer.place(s.body, n);
  placer.place(s.motion, n);
  placer.place(s.after, n);
  placer.place(s.corner, vertices);
  placer.place(s.normal, vertices);
  placer.place(s.vertex, vertices);
  placer.place(s.body_normal, vertices);
  placer.place(s.area, n);
  if (sizes.piece_corners > 0) placer.place(s.piece_corner, sizes.piece_corners);
  place_mooring(s, sizes, placer);
  place_dp(s, sizes, placer);
  if (!sizes.coupled) return placer.used();
  placer.place(s.crushing, n);
  placer.place(s.added, n);
  placer.place(s.solved, n);
  placer.place(s.body_points, n);
  placer.place(s.touched_bodies, (n + 31) / 32);
  placer.place(s.touched_sorted, (n + 31) / 32);
  placer.place(s.momentum_coefficients, sizes.momentum_coefficients);
  return placer.used();
}

std::size_t place_list(DeviceScene& s, const SceneSizes& sizes, std::byte* base) {
  Placer placer(base);
  const std::size_t n = sizes.bodies, rows = sizes.rows, pairs = sizes.rows / 2 + 1;
  s.rows_capacity = sizes.rows;
  s.platform_capacity = sizes.platform_rows;
  s.grid_capacity = grid_cells(sizes.bodies);
  placer.place(s.stamp, rows);  // first, with row_event_step: both are cleared together before a list is built
  placer.place(s.row_event_step, sizes.platform_rows);
  placer.place(s.row_other, rows);
  placer.place(s.row_pair, rows);
  placer.place(s.entry, rows);
  placer.place(s.work, rows);
  placer.place(s.pair, pairs);
  placer.place(s.contact, pairs);
  placer.place(s.touched, pairs);
  placer.place(s.touching, pairs);
  s.phase_blocks = sizes.phase_blocks;
  if (sizes.phases) {
    placer.place(s.candidate, pairs);
    placer.place(s.wake, pairs);
  }
  placer.place(s.last_row, n);
  placer.place(s.last_other, rows);
  placer.place(s.last_pair, rows);
  placer.place(s.last_axes, pairs);
  placer.place(s.box, n);
  placer.place(s.grid_cell, n);
  placer.place(s.grid_floe, n);
  placer.place(s.near_first, kept_near * n);
  placer.place(s.grid_count, s.grid_capacity);
  placer.place(s.grid_begin, s.grid_capacity);
  placer.place(s.near_non_floe, static_cast<std::size_t>(sizes.non_floes) * ((n + 31) / 32));
  placer.place(s.counters, 1);
  placer.place(s.term, 2 * static_cast<std::size_t>(sizes.platform_rows));
  placer.place(s.row_event, sizes.platform_rows);
  if (sizes.coupled) place_solver(s, sizes, placer);
  return placer.used();
}

/// Rows of events that a launch has room for, for each of its time steps. Chosen by hand: a few floes press in drift,
/// about thirty in a jam; a full ring ends the launch early.
constexpr std::int32_t platform_rows_a_step = 16;

/// Forces of each body that a launch has room for, beside those that its last two time steps may need. Chosen by hand:
/// a floe has one or two contacts, so this lasts for about 20 time steps; a full ring ends the launch early.
constexpr std::int32_t forces_of_body = 32;

std::int32_t forces_in_ring(const SceneSizes& sizes) {
  const std::int32_t contacts = contacts_capacity(sizes.rows);
  if (sizes.forces == ForcesWanted::none) return 0;
  return sizes.forces == ForcesWanted::last ? contacts : 2 * contacts + forces_of_body * sizes.bodies;
}

std::size_t place_rings(DeviceScene& s, const SceneSizes& sizes, std::byte* base) {
  Placer placer(base);
  s.events_capacity = std::max(2 * sizes.platform_rows, platform_rows_a_step * sizes.samples);
  // in this order: one copy fetches everything from overlap_count to the last quality
  placer.place(s.overlap_count, 2 * OverlapCount::classes);
  placer.place(s.sample, sizes.samples);
  if (sizes.dp) placer.place(s.dp_sample, sizes.samples);
  placer.place(s.quality, static_cast<std::size_t>(sizes.samples) * static_cast<std::size_t>(sizes.blocks));
  placer.place(s.event, s.events_capacity);
  s.forces_capacity = forces_in_ring(sizes);
  placer.place(s.force, s.forces_capacity);
  if (sizes.drives) placer.place(s.drive, static_cast<std::size_t>(sizes.samples) + 1);
  return placer.used();
}

}  // namespace gem
