#include "gem/engine/reference/reference_motion.h"

#include <cmath>

#include "gem/engine/reference/reference_books.h"
#include "gem/events/events.h"
#include "gem/events/motion.h"
#include "gem/events/platform/platform_drag.h"

namespace gem::reference {
namespace {

bool is_floe(const Bodies& b, std::size_t i) { return b.kind[i] == BodyKind::floe && b.active[i]; }

PlatformSpeed speed_of_platform(const State& s) { return {s.bodies.velocity[0], s.bodies.spin[0]}; }

FloeInEvents floe_in_events(const Bodies& b, std::size_t i) {
  return {b.mass[i],      b.inertia[i],  b.area[i],     b.thickness[i], b.drag[i],
          b.spin_drag[i], b.position[i], b.velocity[i], b.spin[i]};
}

/// Gives the platform a speed that the water has made, and books what the water gave.
void set_by_water(State& s, const PlatformSpeed& after) {
  Bodies& b = s.bodies;
  const Vec2 impulse = b.mass[0] * (after.velocity - b.velocity[0]);
  const double twist = b.inertia[0] * (after.spin - b.spin[0]);
  s.drag_impulse += impulse;
  Quantity& book = s.ledger[Channel::platform_drag];
  book.momentum += impulse;
  book.angular_momentum += cross(b.position[0], impulse) + twist;
  book.energy += 0.5 * dot(impulse, after.velocity + b.velocity[0]) + 0.5 * twist * (after.spin + b.spin[0]);
  b.velocity[0] = after.velocity;
  b.spin[0] = after.spin;
}

/// The water takes its part of a change from `before`. The platform lies as `q` says.
void take_water_along(const Rules& rules, State& s, Rotation q, const PlatformSpeed& before) {
  const AddedMass& a = rules.events.added_mass;
  if (a.present) set_by_water(s, with_water(a, q, before, speed_of_platform(s)));
}

/// The motion that the water gives to a platform that turns: before it turns, or when it has turned to `next`.
void turn_in_water(const Rules& rules, State& s, const Rotation* next) {
  const AddedMass& a = rules.events.added_mass;
  if (!a.present || !a.turns) return;
  const Vec2 water = rules.scene.platform_drag.water == DampingWater::current ? s.drive.water : Vec2{};
  PlatformSpeed speed = speed_of_platform(s);
  speed.velocity -= water;
  const Rotation q = s.bodies.rotation[0];
  const double h = 0.5 * rules.dt;
  speed = next ? after_turn(a, q, *next, speed, h) : before_turn(a, q, speed, h);
  speed.velocity += water;
  set_by_water(s, speed);
}

/// Half a time step of a quadratic law in a stream of water or air.
void drag_platform(const Rules& rules, State& s, double rate, Vec2 stream) {
  if (!(rate > 0.0)) return;
  Bodies& b = s.bodies;
  const Vec2 before = b.velocity[0];
  b.velocity[0] = platform_drag(rate, before, stream, 0.5 * rules.dt);
  const Vec2 impulse = b.mass[0] * (b.velocity[0] - before);
  s.drag_impulse += impulse;
  Quantity& book = s.ledger[Channel::platform_drag];
  book.momentum += impulse;
  book.angular_momentum += cross(b.position[0], impulse);
  book.energy += 0.5 * dot(impulse, b.velocity[0] + before);
}

/// Half a time step of drag by axis, along the world's components of each axis. The platform lies as `q` says.
void drag_by_axis(const Rules& rules, State& s, Rotation q, Vec2 water) {
  const AxisDrag& drag = rules.axis_drag;
  if (!drag.present()) return;
  Bodies& b = s.bodies;
  const double h = 0.5 * rules.dt, spin = b.spin[0];
  const Vec2 before = b.velocity[0], ahead{q.cosine, q.sine}, aside = turned_left(ahead);
  const double surge = dot(ahead, before - water), sway = dot(aside, before - water);
  b.velocity[0] += (slowed(drag.surge, surge, h) - surge) * ahead + (slowed(drag.sway, sway, h) - sway) * aside;
  b.spin[0] = slowed(drag.yaw, spin, h);
  const Vec2 impulse = b.mass[0] * (b.velocity[0] - before);
  const double twist = b.inertia[0] * (b.spin[0] - spin);
  s.drag_impulse += impulse;
  Quantity& book = s.ledger[Channel::platform_drag];
  book.momentum += impulse;
  book.angular_momentum += cross(b.position[0], impulse) + twist;
  book.energy += 0.5 * dot(impulse, b.velocity[0] + before) + 0.5 * twist * (b.spin[0] + spin);
}

void in_water(const Rules& rules, State& s, Rotation q) {
  const bool moves = rules.scene.platform_drag.water == DampingWater::current;
  const Vec2 water = moves ? s.drive.water : Vec2{};
  drag_platform(rules, s, rules.platform_drag_rate, water);
  drag_by_axis(rules, s, q, water);
}

void in_wind(const Rules& rules, State& s) { drag_platform(rules, s, rules.platform_wind_rate, s.drive.air); }

/// Kinetic energy of the platform's drift and energy of its mooring [J].
double swing_energy(const Rules& rules, const Bodies& b) {
  const Vec2 offset = b.position[0] - rules.scene.platform.anchor_m;
  return 0.5 * b.mass[0] * dot(b.velocity[0], b.velocity[0]) + 0.5 * rules.stiffness * dot(offset, offset);
}

void swing_platform(const Rules& rules, State& s) {
  Bodies& b = s.bodies;
  const Vec2 anchor = rules.scene.platform.anchor_m, position = b.position[0], velocity = b.velocity[0];
  const double energy = swing_energy(rules, b);
  Vec2 offset = position - anchor;
  apply(rules.half_mooring, offset, b.velocity[0]);
  b.position[0] = anchor + offset;
  const Vec2 impulse = b.mass[0] * (b.velocity[0] - velocity);
  s.mooring_impulse += impulse;
  s.ledger.mooring_force.momentum += impulse;
  s.ledger.mooring_force.angular_momentum +=
      b.mass[0] * (cross(b.position[0], b.velocity[0]) - cross(position, velocity));
  if (rules.stiffness > 0.0 && rules.scene.mooring.damping_ratio > 0.0)
    s.ledger[Channel::mooring].energy += swing_energy(rules, b) - energy;
}

/// Half a time step of heading control.
void steer(const Rules& rules, State& s, bool damps_first) {
  Bodies& b = s.bodies;
  const HeadingLaw& heading = rules.events.heading;
  if (!heading.present()) return;
  const double decay = heading.decay;
  const double kick =
      heading.half_step * heading_moment(heading.moment, b.rotation[0], s.drive.water) * b.inverse_inertia[0];
  const double before = b.spin[0];
  b.spin[0] = damps_first ? decay * before + kick : decay * (before + kick);
  const double twist = b.inertia[0] * (b.spin[0] - before);
  Quantity& book = s.ledger[Channel::platform_drag];
  book.angular_momentum += twist;
  book.energy += 0.5 * twist * (b.spin[0] + before);
  take_water_along(rules, s, b.rotation[0], {b.velocity[0], before});
}

/// Energy of the platform's motion and of a mooring of any law, with the platform turned to `q` [J].
double moored_energy(const Rules& rules, const State& s, Rotation q) {
  const Bodies& b = s.bodies;
  return 0.5 * b.mass[0] * dot(b.velocity[0], b.velocity[0]) + 0.5 * b.inertia[0] * b.spin[0] * b.spin[0] +
         mooring_pull(rules.events.moored, b.position[0], q, s.broken).energy;
}

/// Half a time step on a mooring of any law. The platform turns to `next` before the mooring pulls. Lines break at the
/// end of the second half.
void swing_on_laws(const Rules& rules, State& s, Rotation next, bool damps_first) {
  Bodies& b = s.bodies;
  const MooringLaws& laws = rules.events.moored;
  const double energy = moored_energy(rules, s, b.rotation[0]);
  const Vec2 velocity = b.velocity[0], moment = {cross(b.position[0], velocity), b.spin[0]};
  const Moored moored{b.position[0], b.velocity[0], b.spin[0], b.mass[0], b.inverse_inertia[0]};
  Quantity water;
  if (damps_first) book_given(water, damp(laws, moored, next));
  book_given(water, swing(laws, moored, next, s.broken));
  if (!damps_first) {
    book_given(water, damp(laws, moored, next));
    s.broken = broken_after(laws, b.position[0], next, s.broken);
  }
  const Vec2 impulse = b.mass[0] * (b.velocity[0] - velocity) - water.momentum;
  s.mooring_impulse += impulse;
  s.ledger.mooring_force.momentum += impulse;
  s.ledger.mooring_force.angular_momentum += b.mass[0] * (cross(b.position[0], b.velocity[0]) - moment.x) +
                                             b.inertia[0] * (b.spin[0] - moment.y) - water.angular_momentum;
  s.ledger[Channel::mooring].energy += moored_energy(rules, s, next) - energy - water.energy;
  s.drag_impulse += water.momentum;
  book_given(s.ledger[Channel::platform_drag], water);
}

/// Half a time step of the thrusters. Force and moment are summed thruster by thruster in the world's axes.
void thrust(const Rules& rules, State& s, bool commands) {
  if (rules.dp.thrusters == 0) return;
  Bodies& b = s.bodies;
  const Rotation q = b.rotation[0];
  const Vec2 before = b.velocity[0];
  const double spin = b.spin[0];
  if (commands) dp_command(rules.dp, {b.position[0], before, q, spin, s.drive.water}, s.dp);
  Vec2 impulse;
  double twist = 0.0;
  for (std::int32_t i = 0; i < rules.dp.thrusters; ++i) {
    const Vec2 push = 0.5 * rules.dt * rotate(q, s.dp.thrust[i]);
    impulse += push;
    twist += cross(rotate(q, rules.dp.thruster[i].position), push);
  }
  b.velocity[0] += b.inverse_mass[0] * impulse;
  b.spin[0] += b.inverse_inertia[0] * twist;
  s.mooring_impulse += impulse;
  s.ledger.mooring_force.momentum += impulse;
  s.ledger.mooring_force.angular_momentum += cross(b.position[0], impulse) + twist;
  s.ledger[Channel::mooring].energy += 0.5 * dot(impulse, b.velocity[0] + before) + 0.5 * twist * (b.spin[0] + spin);
  take_water_along(rules, s, q, {before, spin});
}

/// Half a time step of the thrust of a ship in transit that runs free.
void run_free(const Rules& rules, State& s) {
  if (!rules.thrust.present()) return;
  Bodies& b = s.bodies;
  const double through_water = dot(rules.thrust.course, b.velocity[0] - s.drive.water);
  const double gain = speed_under_thrust(rules.thrust, through_water) - through_water;
  const Vec2 impulse = b.mass[0] * gain * rules.thrust.course;
  s.mooring_impulse += impulse;
  s.ledger.mooring_force.momentum += impulse;
  s.ledger.mooring_force.angular_momentum += cross(b.position[0], impulse);
  s.ledger[Channel::mooring].energy += dot(impulse, b.velocity[0] + 0.5 * gain * rules.thrust.course);
  b.velocity[0] += gain * rules.thrust.course;
}

void turn(Bodies& b, std::size_t i, double angle) {
  if (angle != 0.0) b.rotation[i] = turned(b.rotation[i], angle);
}

/// The position repair of the platform stretches its mooring. The platform turns by `angle` [rad] in the time step, to
/// `next` without the repair.
void repair_platform(const Rules& rules, State& s, double angle, Rotation next) {
  Bodies& b = s.bodies;
  const Vec2 shift = s.repair_shift[0], offset = b.position[0] - rules.scene.platform.anchor_m;
  const double unrepaired = mooring_pull(rules.events.moored, b.position[0], next, s.broken).energy;
  b.position[0] += shift;
  turn(b, 0, angle + s.repair_turn[0]);
  Quantity& book = s.ledger[Channel::repair];
  book.angular_momentum += b.mass[0] * cross(shift, b.velocity[0]);
  if (rules.events.moored.present)
    book.energy += mooring_pull(rules.events.moored, b.position[0], b.rotation[0], s.broken).energy - unrepaired;
  else
    book.energy += rules.stiffness * (dot(offset, shift) + 0.5 * dot(shift, shift));
}

void move_floe(const Rules& rules, State& s, std::size_t i) {
  Bodies& b = s.bodies;
  // a floe that is not struck follows the exact path of its solo events
  const Vec2 beside = s.struck[i] ? s.repair_shift[i] : s.path_correction[i];
  const double angle = s.struck[i] ? s.repair_turn[i] : s.angle_correction[i];
  b.position[i] += rules.dt * b.velocity[i] + beside;
  turn(b, i, rules.dt * b.spin[i] + angle);
  // a shift moves the momentum of the body
  s.ledger[s.struck[i] ? Channel::repair : Channel::drag].angular_momentum += b.mass[i] * cross(beside, b.velocity[i]);
}

}  // namespace

void drive_floes(const Rules& rules, State& s) {
  if (!acts_on_floes(rules.events)) return;
  Bodies& b = s.bodies;
  for (std::size_t i = 0; i < b.count(); ++i) {
    if (!is_floe(b, i)) continue;
    const FloeInEvents floe = floe_in_events(b, i);
    const FloeKick after = floe_events(rules.events, s.drive, floe, floe_drag(rules.events, s.drive, floe));
    b.velocity[i] = after.velocity;
    b.spin[i] = after.spin;
    s.path_correction[i] = after.path_correction;
    s.angle_correction[i] = after.angle_correction;
    const Vec2 impulse = b.mass[i] * (b.velocity[i] - floe.velocity);
    const double twist = b.inertia[i] * (b.spin[i] - floe.spin);
    Quantity& book = s.ledger[Channel::drag];
    book.momentum += impulse;
    book.angular_momentum += cross(b.position[i], impulse) + twist;
    book.energy += 0.5 * dot(impulse, b.velocity[i] + floe.velocity) + 0.5 * twist * (b.spin[i] + floe.spin);
  }
}

/// Leads a ship in transit: it gets the path's velocity, and some of what it lags behind.
void tow_platform(const Rules& rules, State& s) {
  if (!(rules.tow_rate > 0.0)) return;
  Bodies& b = s.bodies;
  const TowStep& to = s.drive.tow;
  const Vec2 lag = to.place - b.position[0];
  Vec2 change = to.velocity + rules.tow_rate * lag - b.velocity[0];
  if (rules.thrust.present()) change -= dot(change, rules.thrust.course) * rules.thrust.course;
  double turn = 0.0;
  if (b.inverse_inertia[0] > 0.0)
    turn = to.spin - b.spin[0] +
           rules.tow_rate * cross({b.rotation[0].cosine, b.rotation[0].sine}, {to.rotation.cosine, to.rotation.sine});
  const Vec2 impulse = b.mass[0] * change;
  s.ledger.mooring_force.momentum += impulse;
  s.ledger.mooring_force.angular_momentum += cross(b.position[0], impulse) + b.inertia[0] * turn;
  s.ledger[Channel::mooring].energy +=
      dot(impulse, b.velocity[0] + 0.5 * change) + b.inertia[0] * turn * (b.spin[0] + 0.5 * turn);
  s.mooring_impulse += impulse;
  b.velocity[0] += change;
  b.spin[0] += turn;
}

void move_platform_before(const Rules& rules, State& s) {
  if (!rules.platform_moves) return;
  tow_platform(rules, s);
  run_free(rules, s);
  thrust(rules, s, true);
  const PlatformSpeed before = speed_of_platform(s);
  in_water(rules, s, s.bodies.rotation[0]);
  in_wind(rules, s);
  take_water_along(rules, s, s.bodies.rotation[0], before);
  if (rules.events.moored.present)
    swing_on_laws(rules, s, s.bodies.rotation[0], true);
  else
    swing_platform(rules, s);
  steer(rules, s, true);
  turn_in_water(rules, s, nullptr);
  s.before_contacts = speed_of_platform(s);
  s.carry_pieces();
}

void move_platform_after(const Rules& rules, State& s) {
  if (!rules.platform_moves) return;
  take_water_along(rules, s, s.bodies.rotation[0], s.before_contacts);
  const double angle = rules.dt * s.bodies.spin[0];
  const Rotation next = turned(s.bodies.rotation[0], angle);
  turn_in_water(rules, s, &next);
  if (rules.events.moored.present)
    swing_on_laws(rules, s, next, false);
  else
    swing_platform(rules, s);
  const PlatformSpeed before = speed_of_platform(s);
  in_wind(rules, s);
  in_water(rules, s, next);
  take_water_along(rules, s, next, before);
  repair_platform(rules, s, angle, next);
  steer(rules, s, false);
  thrust(rules, s, false);
  run_free(rules, s);
  s.carry_pieces();
}

void move_struck_platform(const Rules& rules, State& s, const PlatformSpeed& before) {
  if (!rules.platform_moves) return;
  take_water_along(rules, s, s.bodies.rotation[0], before);
  move_platform_before(rules, s);
  move_platform_after(rules, s);
}

void move_floes(const Rules& rules, State& s) {
  for (std::size_t i = 0; i < s.bodies.count(); ++i)
    if (is_floe(s.bodies, i)) move_floe(rules, s, i);
}

void retire_floes(const Rules& rules, State& s) {
  Bodies& b = s.bodies;
  for (std::size_t i = 0; i < b.count(); ++i) {
    if (!is_floe(b, i) || !(b.position[i].x > rules.scene.output.retire_x_m)) continue;
    const Quantity gone = quantity_of(b, i);
    Quantity& book = s.ledger[Channel::retired];
    book.momentum -= gone.momentum;
    book.angular_momentum -= gone.angular_momentum;
    book.energy -= gone.energy;
    b.active[i] = 0;
  }
}

}  // namespace gem::reference
