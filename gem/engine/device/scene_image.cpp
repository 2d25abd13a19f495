// Copies of bodies, memory of contacts and logs between a field and a device scene.
#include "gem/engine/device/scene_image.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

#include "gem/base/error.h"
#include "gem/engine/device/scene_layout.h"
#include "gem/engine/solver/device/device_solver.h"
#include "gem/engine/solver/splitting/island_view.h"
#include "gem/engine/step/books.h"

namespace gem {
namespace {

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

void write_mooring(const MooringView& mooring, const DeviceScene& s) {
  std::copy_n(mooring.branch, mooring.branches, const_cast<MooringBranch*>(s.mooring_branch));
  std::copy_n(mooring.knot, mooring.knots, const_cast<CurveKnot*>(s.mooring_knot));
}

}  // namespace

void check_device_steps(std::int64_t steps) {
  if (steps > device_steps_maximum)
    throw Error(ExitCode::usage, "the run is too long for engine cuda (" + std::to_string(steps) +
                                     " time steps, allowed at most " + std::to_string(device_steps_maximum) +
                                     "); use --engine cpu, or a longer time step");
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
  if (s.dp) {
    *const_cast<DpLaw*>(s.dp_law) = *f.constants.events.dp;
    *s.dp = f.dp;
  }
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
  std::copy(f.piece_corner.begin(), f.piece_corner.end(), const_cast<PieceCorner*>(s.piece_corner));
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

std::vector<StepForce> forces_of_call(const DeviceScene& rings, const DeviceStatus& status) {
  if (status.forces > rings.forces_capacity)
    throw Error(ExitCode::device, "the GPU lost forces between bodies (" + std::to_string(status.forces) +
                                      ", room for " + std::to_string(rings.forces_capacity) +
                                      "); please report this, and use --engine cpu");
  std::vector<StepForce> forces(rings.force, rings.force + status.forces);
  std::sort(forces.begin(), forces.end(), [](const StepForce& p, const StepForce& q) {
    return std::tie(p.step, p.force.a, p.force.b) < std::tie(q.step, q.force.a, q.force.b);
  });
  return forces;
}

std::vector<ContactForce> forces_of_last_step(const std::vector<StepForce>& forces, std::int64_t step) {
  std::vector<ContactForce> last;
  for (const StepForce& f : forces)
    if (f.step == step - 1) last.push_back(f.force);
  return last;
}

void append_log(const FieldState& f, const DeviceScene& rings, const DeviceStatus& status, int blocks, StepLog& log) {
  if (rings.wants_samples) {
    log.platform.insert(log.platform.end(), rings.sample, rings.sample + status.samples);
    if (rings.dp_sample) log.dp.insert(log.dp.end(), rings.dp_sample, rings.dp_sample + status.samples);
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
