#include "gem/engine/device/scene_image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "gem/base/error.h"
#include "gem/engine/solver/device_solver.h"
#include "gem/engine/solver/splitting/island_view.h"
#include "gem/engine/step/books.h"

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

BodyCell cell_of(const FieldState& f, std::size_t i) {
  const Bodies& b = f.bodies;
  BodyCell cell;
  cell.position = b.position[i];
  cell.turn_travel = f.turn_travel[i];
  cell.radius = b.radius[i];
  cell.vertex_begin = b.vertex_begin[i];
  cell.vertex_count = static_cast<std::int16_t>(b.vertex_count(i));
  cell.kind = b.kind[i];
  cell.active = b.active[i];
  cell.rotation = b.rotation[i];
  cell.velocity = b.velocity[i];
  cell.spin = b.spin[i];
  cell.inverse_mass = b.inverse_mass[i];
  cell.inverse_inertia = b.inverse_inertia[i];
  cell.thickness = b.thickness[i];
  return cell;
}

BodyMotion motion_of(const Bodies& b, std::size_t i) {
  BodyMotion motion;
  motion.mass = b.mass[i];
  motion.inertia = b.inertia[i];
  motion.drag = b.drag[i];
  motion.spin_drag = b.spin_drag[i];
  return motion;
}

/// Makes events from records. Turns the outlines to where they stood.
class EventReader {
 public:
  explicit EventReader(const FieldState& f) : f_(f) {}

  ContactEvent read(const PlatformEventRecord& record) {
    const Contact& contact = record.contact;
    EventBodies bodies;
    bodies.mass_a = {f_.bodies.inverse_mass[contact.a], f_.bodies.inverse_inertia[contact.a]};
    bodies.mass_b = {f_.bodies.inverse_mass[contact.b], f_.bodies.inverse_inertia[contact.b]};
    bodies.position_b = record.position_b;
    bodies.offset = record.position_b - record.platform_position;
    bodies.outline_a = turned(contact.a, record.rotation_a, 0);
    bodies.outline_b = turned(contact.b, record.rotation_b, 1);
    bodies.ice = crushing_ice(
        f_.constants.events,
        crushed_thickness(f_.bodies.kind[contact.a], f_.bodies.thickness[contact.a], f_.bodies.thickness[contact.b]));
    return event_of(contact, bodies, static_cast<double>(record.step) * f_.constants.dt);
  }

 private:
  Outline turned(std::int32_t body, Rotation q, int side) {
    std::vector<Vec2>&corner = corner_[side], &normal = normal_[side];
    corner.clear();
    normal.clear();
    for (std::int32_t v = f_.bodies.vertex_begin[body]; v < f_.bodies.vertex_begin[body + 1]; ++v) {
      corner.push_back(rotate(q, f_.bodies.vertex[v]));
      normal.push_back(rotate(q, f_.body_normal[v]));
    }
    return {corner.data(), normal.data(), static_cast<int>(corner.size())};
  }

  const FieldState& f_;
  std::vector<Vec2> corner_[2], normal_[2];
};

/// The worst quality of all blocks. Independent time steps do not measure it after their events: those numbers are NaN.
StepQuality quality_of(const BlockQuality* block, int blocks, ContactSolver solver) {
  StepQuality quality;
  for (int k = 0; k < blocks; ++k) {
    quality.contacts += block[k].contacts;
    quality.iterations = std::max(quality.iterations, block[k].iterations);
    quality.residual = std::max(quality.residual, block[k].residual);
    quality.maximum_share = std::max(quality.maximum_share, strict::double_of(block[k].share));
    quality.complementarity = std::max(quality.complementarity, strict::double_of(block[k].complementarity));
    quality.cone_excess = std::max(quality.cone_excess, strict::double_of(block[k].cone_excess));
    quality.energy_created = std::max(quality.energy_created, block[k].energy_created);
    quality.maximum_overlap = std::max(quality.maximum_overlap, strict::double_of(block[k].overlap));
  }
  if (solver == ContactSolver::independent)
    quality.complementarity = quality.cone_excess = quality.energy_created = std::numeric_limits<double>::quiet_NaN();
  return quality;
}

/// Other bodies of all fronts, and numbers of all factors, for each body and each halving of the scene. Fronts of
/// islands in jams need a tenth of it.
constexpr std::size_t slots_of_body = 8, numbers_of_body = 200;

void place_islands(DeviceScene& s, const SceneSizes& sizes, Placer& placer) {
  IslandMemory& m = s.island;
  const std::size_t n = sizes.bodies, points = s.points_capacity, records = s.push_capacity;
  const auto halvings = static_cast<std::size_t>(std::bit_width(n + 1));
  const std::size_t slots = slots_of_body * n * halvings, numbers = numbers_of_body * n * halvings;
  m.slots_capacity = static_cast<std::int32_t>(std::min<std::size_t>(slots, std::numeric_limits<std::int32_t>::max()));
  m.numbers_capacity = std::min<std::size_t>(numbers, std::numeric_limits<std::int32_t>::max());
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

void write_mooring(const MooringView& mooring, const DeviceScene& s) {
  std::copy_n(mooring.branch, mooring.branches, const_cast<MooringBranch*>(s.mooring_branch));
  std::copy_n(mooring.knot, mooring.knots, const_cast<CurveKnot*>(s.mooring_knot));
}

}  // namespace

void check_device_steps(std::int64_t steps) {
  if (steps > device_steps_maximum)
    throw Error(ExitCode::usage, "the run is too long for engine cuda (" + std::to_string(steps) +
                                     " time steps, allowed at most " + std::to_string(device_steps_maximum) +
                                     ") use --engine cpu, or a longer time step");
}

SceneSizes scene_sizes(const FieldState& f) {
  const Bodies& b = f.bodies;
  SceneSizes sizes;
  sizes.bodies = static_cast<std::int32_t>(b.count());
  sizes.non_floes = static_cast<std::int32_t>(
      std::count_if(b.kind.begin(), b.kind.end(), [](BodyKind kind) { return kind != BodyKind::floe; }));
  sizes.vertices = static_cast<std::int32_t>(b.vertex.size());
  sizes.rows = 8 * sizes.bodies + 256;
  sizes.platform_rows = 256;
  sizes.phase_blocks = (sizes.bodies + phase_threads - 1) / phase_threads;
  sizes.coupled = f.constants.solver == ContactSolver::coupled;
  sizes.momentum_coefficients = f.momentum_coefficients.size();
  sizes.splitting = sizes.coupled && f.constants.iteration == Iteration::splitting;
  sizes.mooring_branches = f.constants.events.moored.view.branches;
  sizes.mooring_knots = f.constants.events.moored.view.knots;
  sizes.phases = !sizes.coupled || sizes.splitting || sizes.bodies <= most_cluster_bodies;
  return sizes;
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
  place_mooring(s, sizes, placer);
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

std::size_t place_rings(DeviceScene& s, const SceneSizes& sizes, std::byte* base) {
  Placer placer(base);
  s.events_capacity = std::max(2 * sizes.platform_rows, platform_rows_a_step * sizes.samples);
  // in this order: one copy fetches everything from overlap_count to the last quality
  placer.place(s.overlap_count, 2 * OverlapCount::classes);
  placer.place(s.sample, sizes.samples);
  placer.place(s.quality, static_cast<std::size_t>(sizes.samples) * static_cast<std::size_t>(sizes.blocks));
  placer.place(s.event, s.events_capacity);
  if (sizes.drives) placer.place(s.drive, static_cast<std::size_t>(sizes.samples) + 1);
  return placer.used();
}

void write_drives(const DriveSchedule& drives, std::int64_t first, std::int64_t steps, Drive* to) {
  for (std::int64_t k = 0; k <= steps; ++k) to[k] = drives.at(first + k);
}

DeviceScene scene_constants(const FieldState& f) {
  DeviceScene s;
  const SceneSizes sizes = scene_sizes(f);
  s.constants = f.constants;
  s.horizon = f.constants.list_horizon;
  s.bodies = sizes.bodies;
  s.non_floes = sizes.non_floes;
  return s;
}

void write_field(const FieldState& f, std::int64_t step, const DeviceScene& s) {
  *s.status = {};
  s.status->step = step;
  s.status->horizon = s.horizon;
  *s.platform = {};
  s.platform->velocity = f.bodies.velocity[0];
  s.platform->spin = f.bodies.spin[0];
  s.platform->mooring_force = f.mooring_force;
  s.platform->broken = f.broken;
  write_mooring(f.constants.events.moored.view, s);
  for (std::size_t i = 0; i < f.bodies.count(); ++i) {
    s.body[i] = cell_of(f, i);
    s.motion[i] = motion_of(f.bodies, i);
    s.after[i] = {f.bodies.velocity[i], f.bodies.spin[i]};
  }
  std::copy(f.bodies.area.begin(), f.bodies.area.end(), const_cast<double*>(s.area));
  if (s.added) {
    std::copy(f.crushing.begin(), f.crushing.end(), const_cast<CrushingPowers*>(s.crushing));
    std::fill_n(s.added, f.bodies.count(), AddedMotion{});
    std::fill_n(s.solved, f.bodies.count(), SolvedMotion{});
    std::fill_n(s.body_points, f.bodies.count(), BodyPoints{});
    std::fill_n(s.touched_bodies, (f.bodies.count() + 31) / 32, 0U);
    std::fill_n(s.touched_sorted, (f.bodies.count() + 31) / 32, 0U);
    std::copy(f.momentum_coefficients.begin(), f.momentum_coefficients.end(),
              const_cast<float*>(s.momentum_coefficients));
  }
  std::copy(f.books.begin(), f.books.end(), s.books);
  std::copy(f.corner.begin(), f.corner.end(), s.corner);
  std::copy(f.normal.begin(), f.normal.end(), s.normal);
  std::copy(f.bodies.vertex.begin(), f.bodies.vertex.end(), const_cast<Vec2*>(s.vertex));
  std::copy(f.body_normal.begin(), f.body_normal.end(), const_cast<Vec2*>(s.body_normal));
}

std::vector<CarriedMemory> carried_memory(const EngineState& state) {
  std::vector<CarriedMemory> all;
  for (std::size_t k = 0; k < state.impulse_key.size(); ++k) {
    const std::uint64_t key = state.impulse_key[k];
    const std::int32_t a = body_a_of(key), b = body_b_of(key);
    const bool second = !all.empty() && all.back().a == a && all.back().b == b;
    if (!second) all.push_back({a, b, {-1, -1}, {}});
    all.back().feature[second ? 1 : 0] = feature_of(key);
    all.back().point[second ? 1 : 0] = state.impulse_value[k];
  }
  return all;
}

void save_memory(std::vector<CarriedMemory> carried, EngineState& state) {
  std::sort(carried.begin(), carried.end(), [](const CarriedMemory& p, const CarriedMemory& q) {
    return contact_key(p.a, p.b, 0) < contact_key(q.a, q.b, 0);
  });
  for (const CarriedMemory& contact : carried)
    for (int k = 0; k < 2; ++k) {
      if (contact.feature[k] < 0) continue;
      state.impulse_key.push_back(contact_key(contact.a, contact.b, contact.feature[k]));
      state.impulse_value.push_back(contact.point[k]);
    }
}

void read_state(const BodyState* state, FieldState& f) {
  Bodies& b = f.bodies;
  for (std::size_t i = 0; i < b.count(); ++i) {
    b.position[i] = state[i].position;
    b.rotation[i] = state[i].rotation;
    b.velocity[i] = state[i].velocity;
    b.spin[i] = state[i].spin;
    b.active[i] = static_cast<std::uint8_t>(state[i].active);
  }
}

void append_log(const FieldState& f, const DeviceScene& rings, const DeviceStatus& status, int blocks, StepLog& log) {
  if (rings.wants_samples) {
    log.platform.insert(log.platform.end(), rings.sample, rings.sample + status.samples);
    for (std::int32_t m = 0; m < status.samples; ++m)
      log.quality.push_back(quality_of(rings.quality + m * blocks, blocks, f.constants.solver));
    for (int k = 0; k < OverlapCount::classes; ++k) {
      log.overlap.count[k] += rings.overlap_count[k];
      log.overlap_share.count[k] += rings.overlap_count[OverlapCount::classes + k];
    }
  }
  EventReader reader(f);
  for (std::int32_t k = 0; k < status.events; ++k) log.events.push_back(reader.read(rings.event[k]));
}

}  // namespace gem
