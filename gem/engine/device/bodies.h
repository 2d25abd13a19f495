// The body stages of a time step. Each body adds up its contacts, moves, and takes the solo events of the next time
// step.
#pragma once

#include "gem/engine/device/row_sums.h"
#include "gem/engine/step/body_repair.h"

namespace gem {

/// One time step, as its phases need it.
struct StepIndex {
  std::int32_t step = 0;
  std::int32_t sample = 0;  // index in the rings of this call
  double elapsed = 0.0;     // from the building of the list to the end of the time step [s]
  bool kick_next = true;    // make the solo events of the next time step too
};

GEM_DEVICE inline bool is_number(double x) { return x - x == 0.0; }

/// The part of a body that a time step changes, in registers until the end of the time step.
struct Mover {
  Vec2 position;
  Rotation rotation;
  double turn_travel = 0.0;
  Vec2 velocity;
  double spin = 0.0;
};

GEM_DEVICE inline Mover mover_of(const BodyCell& cell) {
  return {cell.position, cell.rotation, cell.turn_travel, cell.velocity, cell.spin};
}

/// Copies field by field: the compiler copies whole cells byte by byte.
GEM_DEVICE inline void write_mover(BodyCell& cell, const Mover& mover) {
  cell.position = mover.position;
  cell.rotation = mover.rotation;
  cell.turn_travel = mover.turn_travel;
  cell.velocity = mover.velocity;
  cell.spin = mover.spin;
}

/// Turns a body by `angle` [rad]. Returns whether it turned at all.
GEM_DEVICE inline bool turn(Mover& mover, double angle) {
  if (angle == 0.0) return false;
  mover.rotation = turned(mover.rotation, angle);
  mover.turn_travel += angle < 0.0 ? -angle : angle;
  return true;
}

/// Turns the corners first, first + step, ... of an outline to rotation `q`.
GEM_DEVICE inline void turn_outline(const DeviceScene& s, std::int32_t begin, int count, Rotation q, int first,
                                    int step) {
  for (int v = first; v < count; v += step) {
    const Vec2 corner = s.vertex[begin + v], normal = s.body_normal[begin + v];
    s.corner[begin + v] = rotate(q, corner);
    s.normal[begin + v] = rotate(q, normal);
  }
}

/// Whether a body left the straight path that the list assumes by more than the list allows. `elapsed`: time since the
/// list was built [s].
GEM_DEVICE inline bool left_trajectory(const DeviceScene& s, const Mover& mover, double radius,
                                       const BodyMotion& motion, double elapsed) {
  const Vec2 offset = mover.position - motion.trajectory_position - elapsed * motion.trajectory_velocity;
  const double allowed_offset = 0.5 * s.constants.list_margin - radius * (mover.turn_travel - motion.trajectory_turned);
  return !(allowed_offset > 0.0 && dot(offset, offset) < allowed_offset * allowed_offset);
}

/// The solo events of the next time step, number `sample` of the call, on a floe that moves as `after` says.
GEM_DEVICE inline void kick_body(const DeviceScene& s, std::int32_t i, const BodyCell& cell, Mover& mover,
                                 BodyMotion& motion, const BodyAfter& after, Quantity& drag_book, std::int32_t sample) {
  mover.velocity = after.velocity;
  mover.spin = after.spin;
  const Events& e = s.constants.events;
  if (!acts_on_floes(e)) return;
  const FloeInEvents floe{motion.mass,      motion.inertia, s.area[i],      cell.thickness, motion.drag,
                          motion.spin_drag, mover.position, after.velocity, after.spin};
  const Drive drive = s.drive_of(sample);
  const FloeKick kick = floe_events(e, drive, floe, floe_drag(e, drive, floe));
  book_kick(drag_book, floe, kick);
  mover.velocity = kick.velocity;
  mover.spin = kick.spin;
  motion.path_correction = kick.path_correction;
  motion.angle_correction = kick.angle_correction;
}

/// Takes the velocity and the repair of body i from a coupled solution. Returns whether the body has points in this
/// time step.
GEM_DEVICE inline bool load_solved(const DeviceScene& s, std::int32_t i, std::int32_t step, BodyAfter& after,
                                   BodyRepair& repair) {
  if (s.body_points[i].step != step) return false;
  const SolvedMotion& solved = s.solved[i];
  after.velocity = {solved.part[0], solved.part[1]};
  after.spin = solved.part[4];
  repair = within_reach({{solved.part[2], solved.part[3]}, solved.part[5]}, s.body[i].radius, s.constants.repair_reach);
  return true;
}

/// Moves a floe with its velocity after the events. Returns whether it turned.
GEM_DEVICE inline bool drift(const DeviceScene& s, Mover& mover, const BodyMotion& motion, const BodyAfter& after,
                             bool struck, const BodyRepair& repair, Quantity& drag_book) {
  const double dt = s.constants.dt;
  double angle = dt * after.spin;
  if (struck) {
    mover.position += dt * after.velocity + repair.shift;
    angle += repair.turn;
  } else {
    const Vec2 path_correction = motion.path_correction;
    mover.position += dt * after.velocity + path_correction;
    angle += motion.angle_correction;
    drag_book.angular_momentum += motion.mass * cross(path_correction, after.velocity);
  }
  return turn(mover, angle);
}

GEM_DEVICE inline bool is_finite(const Mover& mover, Vec2 velocity, double spin) {
  return is_number(mover.position.x + mover.position.y + velocity.x + velocity.y + spin + mover.rotation.cosine +
                   mover.rotation.sine);
}

/// The body stages of one floe or fixed body.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void move_body(const DeviceScene& s, Group& group, const Workspace& workspace, std::int32_t i,
                                 const StepIndex& step) {
  if (s.constants.is_platform(i)) return;  // a warp of its own moves it
  BodyCell& cell = workspace.body[i];
  BodyMotion& motion = workspace.motion[i];
  Quantity drag_book = s.book(Channel::drag, i);
  Mover mover = mover_of(cell);
  BodyAfter after{mover.velocity, mover.spin};
  BodyRepair repair;
  bool struck = add_row<solver>(s, i, cell, motion, step.step, after);
  if (cell.kind != BodyKind::floe || !cell.active) return;
  if constexpr (solver == ContactSolver::coupled) {
    struck = load_solved(s, i, step.step, after, repair);
    if (struck) s.book(Channel::repair, i).angular_momentum += motion.mass * cross(repair.shift, after.velocity);
  }
  const bool turned = drift(s, mover, motion, after, struck, repair, drag_book);
  const bool finite = is_finite(mover, after.velocity, after.spin);
  const bool retires = finite && mover.position.x > s.constants.retire_x;
  if (!finite) group.raise(alarm_not_finite);
  if (retires)
    book_gone(s.book(Channel::retired, i),
              quantity_of(motion.mass, motion.inertia, mover.position, after.velocity, after.spin));
  else if (left_trajectory(s, mover, cell.radius, motion, step.elapsed))
    group.raise(alarm_strayed);
  if (step.kick_next && !retires) kick_body(s, i, cell, mover, motion, after, drag_book, step.sample + 1);
  if (step.kick_next && retires) {
    mover.velocity = after.velocity;
    mover.spin = after.spin;
  }
  write_mover(cell, mover);
  if (retires) s.body[i].active = cell.active = 0;
  if (workspace.writes_through) write_mover(s.body[i], mover);
  s.after[i].velocity = after.velocity;
  s.after[i].spin = after.spin;
  Quantity& book = s.book(Channel::drag, i);
  book.momentum = drag_book.momentum;
  book.angular_momentum = drag_book.angular_momentum;
  book.energy = drag_book.energy;
  if (turned && cell.vertex_count > workspace_vertices)
    turn_outline(s, cell.vertex_begin, cell.vertex_count, mover.rotation, 0, 1);
}

}  // namespace gem
