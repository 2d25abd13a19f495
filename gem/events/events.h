// The list of all events. Solo events act on one body, pair events on two. The engines include this file and no other
// law.
//
// A new law is a header in this folder (in platform/ if it is one of the platform) with its definition, and a test.
// Here it gets one member (EventDefinitions) and one call; its keys go into the schema. A law of floes changes no
// engine file. One of the platform or of pairs may: see "How to add a law" in gem/manual/architecture.md.
#pragma once

#include "gem/events/breakup.h"
#include "gem/events/contact_def.h"
#include "gem/events/coriolis.h"                 // solo: Coriolis force on a floe
#include "gem/events/crushing.h"                 // pair: closed-form peak of an impact
#include "gem/events/current_drag.h"             // solo: water drag on a floe
#include "gem/events/drive.h"                    // velocities of water and air over time
#include "gem/events/elastic_contact.h"          // pair: static stress
#include "gem/events/friction_memory.h"          // pair: friction of a hit that takes two time steps
#include "gem/events/impact.h"                   // pair: plastic impact with friction
#include "gem/events/mass_reduction.h"           // pair: effective mass
#include "gem/events/motion.h"                   // solo: motion
#include "gem/events/platform/added_mass.h"      // solo: water that the platform sets in motion
#include "gem/events/platform/dp.h"              // solo: dynamic positioning of the platform
#include "gem/events/platform/heading.h"         // solo: heading control of the platform
#include "gem/events/platform/mooring.h"         // solo: platform on its linear mooring
#include "gem/events/platform/mooring_laws.h"    // solo: platform on tables, lines, yaw stiffness
#include "gem/events/platform/platform_drag.h"   // solo: water drag on the platform
#include "gem/events/platform/transit.h"         // solo: the platform as a ship on its way
#include "gem/events/platform/transit_thrust.h"  // solo: thrust of a ship on its way
#include "gem/events/quantity.h"
#include "gem/events/wind.h"  // solo: wind on a floe and on the platform

namespace gem {

/// The definitions of all laws: the sections of a case file with these names.
struct EventDefinitions {
  CurrentDef current;
  WaterDef water;
  IceDef ice;
  MooringDef mooring;
  AddedMassDef added_mass;
  PlatformDragDef platform_drag;
  ContactDef contact;
  WindDef wind;
  CoriolisDef coriolis;
  HeadingDef heading;
  BreakupDef breakup;
};

/// The platform's properties that the laws read.
struct PlatformInEvents {
  Vec2 anchor;                // [m]
  double mass = 0.0;          // [kg]
  double diameter = 0.0;      // width on which the water drags, across its x axis [m]
  double length = 0.0;        // along its x axis, for drag by axis [m]
  double inertia = 0.0;       // [kg m2]
  bool turns = false;         // its yaw is free
  MooringView mooring;        // tables of the mooring
  const DpLaw* dp = nullptr;  // dynamic positioning; null: none
  bool towed = false;         // it is in transit
  ThrustLaw thrust = {};      // of a ship in transit that runs free
};

/// The laws of one run: their definitions and the constants derived from them. Plain values, copied to any device.
struct Events : EventDefinitions {
  double dt = 0.0;            // time step [s]
  double linear_decay = 1.0;  // e^(-dt/tau) of the linear drag
  Turning turning;            // of the quadratic drag
  bool drag_is_turned = false;
  bool floes_are_pushed = false;  // by wind or Coriolis force, half before the drag and half after it
  bool wind_on_floes = false;
  Rotation half_coriolis;  // over dt / 2
  double freeboard = 0.0;  // share of a floe's thickness above the water [-]

  bool platform_present = false;
  Vec2 anchor;               // [m]
  MooringFlow half_mooring;  // over dt / 2
  bool mooring_damped = false;
  MooringLaws moored;               // if the mooring is more than linear in surge and sway
  double platform_drag_rate = 0.0;  // of the round law [1/m]; 0: none
  AxisDrag axis_drag;
  AddedMass added_mass;
  double platform_wind_rate = 0.0;  // [1/m]; 0: none
  HeadingLaw heading;
  const DpLaw* dp = nullptr;  // null: no dynamic positioning
  double tow_rate = 0.0;      // of a ship in transit [1/s]; 0: none
  ThrustLaw thrust;
};

/// Returns the laws of a run. `platform`: null without a platform; `dt` in [s]; `wind`: there is wind at some time.
/// Host only, once per run.
Events make_events(const EventDefinitions& definitions, const PlatformInEvents* platform, double dt, bool wind);

/// The drive of a run without tables.
GEM_HD inline Drive steady_drive(const EventDefinitions& e) {
  return {e.current.velocity_m_per_s, e.wind.velocity_m_per_s, {}};
}

// ---- solo events of a floe

/// A floe at the start of a time step: all that solo events may read.
struct FloeInEvents {
  double mass, inertia;    // [kg], [kg m2]
  double area, thickness;  // [m2], [m]
  double drag, spin_drag;  // quadratic law: k [1/m] and spin coefficient [-]; linear law: 1/tau [1/s]
  Vec2 position, velocity;
  double spin;  // [rad/s]
};

/// A floe after its solo events.
struct FloeKick {
  Vec2 velocity;                  // [m/s]
  double spin = 0.0;              // [rad/s]
  Vec2 path_correction;           // exact path under the events minus velocity x dt [m]
  double angle_correction = 0.0;  // [rad]
};

/// The effect of the current on slip and spin of a floe.
struct FloeDrag {
  DragSolution slip;
  SpinDragSolution spin;
};

/// Velocity of a floe after half a time step of wind.
GEM_HD inline Vec2 half_blown(const Events& e, const Drive& drive, const FloeInEvents& floe, Vec2 velocity) {
  if (!e.wind_on_floes) return velocity;
  const double rate = floe_wind_rate(e.wind, e.freeboard, floe.thickness, floe.area, floe.mass);
  return blown(rate, velocity, drive.air, 0.5 * e.dt);
}

/// Velocity of a floe after half a time step of Coriolis force.
GEM_HD inline Vec2 half_turned(const Events& e, const Drive& drive, Vec2 velocity) {
  return drive.water + rotate(e.half_coriolis, velocity - drive.water);
}

/// Velocity from which the water drags a floe: the events beside the drag act for half a time step before it.
GEM_HD inline Vec2 velocity_before_drag(const Events& e, const Drive& drive, const FloeInEvents& floe) {
  if (!e.floes_are_pushed) return floe.velocity;
  return half_blown(e, drive, floe, half_turned(e, drive, floe.velocity));
}

/// Water drag by the law of the case.
GEM_HD inline FloeDrag floe_drag(const Events& e, const Drive& drive, const FloeInEvents& floe) {
  const Vec2 slip = drive.water - velocity_before_drag(e, drive, floe);
  FloeDrag drag{{slip, {}}, {floe.spin, 0.0}};
  if (e.water.drag_law == DragLaw::quadratic) {
    drag.slip = e.drag_is_turned ? drag_turned(floe.drag, e.turning, slip, length(slip), e.dt)
                                 : drag_quadratic(floe.drag, slip, length(slip), e.dt);
    if (floe.spin_drag > 0.0) drag.spin = spin_drag_quadratic(floe.spin_drag, floe.spin, e.dt);
  } else if (e.water.drag_law == DragLaw::linear) {
    drag.slip = drag_linear(floe.drag, slip, e.linear_decay, e.dt);
    if (floe.spin_drag > 0.0) drag.spin = spin_drag_linear(floe.spin_drag, floe.spin, e.linear_decay, e.dt);
  }
  return drag;
}

/// Whether floes have any solo event in this run.
GEM_HD inline bool acts_on_floes(const Events& e) { return e.water.drag_law != DragLaw::none || e.floes_are_pushed; }

/// Whether the drag of the water is the only solo event of floes, and quadratic.
inline bool only_drags_floes(const Events& e) {
  return e.water.drag_law == DragLaw::quadratic && !e.drag_is_turned && !e.floes_are_pushed;
}

/// All solo events of one floe over a time step, one call per law. `drag` is floe_drag() of the floe; a loop over many
/// floes may compute it for several at a time.
GEM_HD inline FloeKick floe_events(const Events& e, const Drive& drive, const FloeInEvents& floe,
                                   const FloeDrag& drag) {
  FloeKick kick{drive.water - drag.slip.slip, drag.spin.spin, -drag.slip.path_correction, drag.spin.angle_correction};
  if (e.floes_are_pushed) {
    // the floe moves on its path under the drag; what changes its velocity after it is no part of the path
    const Vec2 dragged = kick.velocity;
    kick.velocity = half_turned(e, drive, half_blown(e, drive, floe, dragged));
    kick.path_correction += e.dt * (dragged - kick.velocity);
  }
  return kick;
}

/// Books what water, wind and Coriolis force gave to a floe.
GEM_HD inline void book_kick(Quantity& book, const FloeInEvents& floe, const FloeKick& kick) {
  const Vec2 impulse = floe.mass * (kick.velocity - floe.velocity);
  const double twist = floe.inertia * (kick.spin - floe.spin);
  book.momentum += impulse;
  book.angular_momentum += cross(floe.position, impulse) + twist;
  book.energy += 0.5 * dot(impulse, kick.velocity + floe.velocity) + 0.5 * twist * (kick.spin + floe.spin);
}

// ---- solo events of the platform

/// The platform's state, and the books of its own motion.
struct PlatformMotion {
  double mass;     // [kg]
  Vec2& position;  // [m]
  Vec2& velocity;  // [m/s]
  Quantity& drag_book;
  Quantity& mooring_book;
  Quantity& mooring_force;
  // only for drag by axis and for laws beyond the linear mooring
  double inertia, inverse_inertia;  // [kg m2], [1/(kg m2)]
  double& spin;                     // [rad/s]
  Rotation rotation, next;          // at the start of the half step, and when the laws act; see yaw_of_pull()
  LineSet& broken;
};

/// Velocity of the water around the platform, for its drag [m/s].
GEM_HD inline Vec2 platform_water(const Events& e, const Drive& drive) {
  return e.platform_drag.water == DampingWater::current ? drive.water : Vec2{};
}

/// Sets the platform's velocity and books the change as drag.
GEM_HD inline void push_platform(const PlatformMotion& p, Vec2 velocity) {
  const Vec2 before = p.velocity;
  p.velocity = velocity;
  const Vec2 impulse = p.mass * (p.velocity - before);
  p.drag_book.momentum += impulse;
  p.drag_book.angular_momentum += cross(p.position, impulse);
  p.drag_book.energy += 0.5 * dot(impulse, p.velocity + before);
}

/// Half a time step of water drag by axis, with the axes as the platform lies then.
GEM_HD inline void drag_by_axis(const Events& e, const Drive& drive, const PlatformMotion& p) {
  push_platform(p, platform_drag(e.axis_drag, p.next, p.velocity, platform_water(e, drive), 0.5 * e.dt));
  if (!(e.axis_drag.yaw > 0.0)) return;
  const double before = p.spin;
  p.spin = slowed(e.axis_drag.yaw, before, 0.5 * e.dt);
  const double twist = p.inertia * (p.spin - before);
  p.drag_book.angular_momentum += twist;
  p.drag_book.energy += 0.5 * twist * (p.spin + before);
}

/// A platform whose speed has changed, and the book of what the water gives.
struct MovedPlatform {
  Rotation rotation;
  Vec2 position;   // [m]
  Vec2& velocity;  // [m/s]
  double& spin;    // [rad/s]
  Quantity& book;
};

/// The water takes its part of a change from `before`.
GEM_HD inline void take_water_along(const Events& e, const MovedPlatform& p, const PlatformSpeed& before) {
  const AddedMass& a = e.added_mass;
  if (!a.present) return;
  const PlatformSpeed alone{p.velocity, p.spin}, after = with_water(a, p.rotation, before, alone);
  p.velocity = after.velocity;
  p.spin = after.spin;
  book_given(p.book, given_by_water(a, p.position, alone, after));
}

/// The motion that the water gives to a platform that turns: its half before the pair events with `next` at its present
/// rotation, else the half after them, when it has turned to `next`.
GEM_HD inline void turn_in_water(const Events& e, const Drive& drive, const MovedPlatform& p, Rotation next,
                                 bool turns_first) {
  const AddedMass& a = e.added_mass;
  if (!a.present || !a.turns) return;
  const Vec2 water = platform_water(e, drive);
  const PlatformSpeed before{p.velocity, p.spin}, slip{p.velocity - water, p.spin};
  const double h = 0.5 * e.dt;
  const PlatformSpeed after =
      turns_first ? after_turn(a, p.rotation, next, slip, h) : before_turn(a, p.rotation, slip, h);
  p.velocity = water + after.velocity;
  p.spin = after.spin;
  book_given(p.book, given_by_water(a, p.position, before, {p.velocity, p.spin}));
}

/// Half a time step of water drag.
GEM_HD inline void platform_in_water(const Events& e, const Drive& drive, const PlatformMotion& p) {
  if (e.axis_drag.present()) drag_by_axis(e, drive, p);
  if (!(e.platform_drag_rate > 0.0)) return;
  push_platform(p, platform_drag(e.platform_drag_rate, p.velocity, platform_water(e, drive), 0.5 * e.dt));
}

/// Half a time step of wind.
GEM_HD inline void platform_in_wind(const Events& e, const Drive& drive, const PlatformMotion& p) {
  if (!(e.platform_wind_rate > 0.0)) return;
  push_platform(p, blown(e.platform_wind_rate, p.velocity, drive.air, 0.5 * e.dt));
}

/// Half a time step on the linear mooring.
GEM_HD inline void platform_on_spring(const Events& e, const PlatformMotion& p) {
  const double stiffness = e.mooring.stiffness_N_per_m;
  const Vec2 velocity = p.velocity;
  const double moment_of_momentum = cross(p.position, velocity);
  Vec2 offset = p.position - e.anchor;
  const double energy = 0.5 * p.mass * dot(velocity, velocity) + 0.5 * stiffness * dot(offset, offset);
  apply(e.half_mooring, offset, p.velocity);
  p.position = e.anchor + offset;
  p.mooring_force.momentum += p.mass * (p.velocity - velocity);
  p.mooring_force.angular_momentum += p.mass * (cross(p.position, p.velocity) - moment_of_momentum);
  if (e.mooring_damped)
    p.mooring_book.energy +=
        0.5 * p.mass * dot(p.velocity, p.velocity) + 0.5 * stiffness * dot(offset, offset) - energy;
}

/// The platform's rotation when mooring and drag act after the pair events: it has turned over the time step. Where no
/// law looks at it, it stays as it was.
GEM_HD inline Rotation yaw_of_pull(const Events& e, Rotation q, double spin) {
  return e.moored.present || e.axis_drag.present() || e.added_mass.present ? turned(q, e.dt * spin) : q;
}

/// Energy of the platform's motion and of its mooring [J].
GEM_HD inline double moored_energy(const Events& e, const PlatformMotion& p, Rotation q) {
  return kinetic_energy(p.mass, p.inertia, p.velocity, p.spin) + mooring_pull(e.moored, p.position, q, p.broken).energy;
}

/// Half a time step on a mooring of any law. `damps_first`: damping before the pull, in the first half of a time step;
/// else after it, and lines may break.
GEM_HD inline void platform_on_laws(const Events& e, const PlatformMotion& p, bool damps_first) {
  const Vec2 velocity = p.velocity;
  const double moment_of_momentum = cross(p.position, velocity), spin = p.spin,
               energy = moored_energy(e, p, p.rotation);
  const Moored moored{p.position, p.velocity, p.spin, p.mass, p.inverse_inertia};
  Quantity water;
  if (damps_first) book_given(water, damp(e.moored, moored, p.next));
  book_given(water, swing(e.moored, moored, p.next, p.broken));
  if (!damps_first) {
    book_given(water, damp(e.moored, moored, p.next));
    p.broken = broken_after(e.moored, p.position, p.next, p.broken);
  }
  p.mooring_force.momentum += p.mass * (p.velocity - velocity) - water.momentum;
  p.mooring_force.angular_momentum += p.mass * (cross(p.position, p.velocity) - moment_of_momentum) +
                                      p.inertia * (p.spin - spin) - water.angular_momentum;
  p.mooring_book.energy += moored_energy(e, p, p.next) - energy - water.energy;
  if (e.added_mass.present) book_given(p.drag_book, water);
}

/// Half a time step on the mooring.
GEM_HD inline void platform_on_mooring(const Events& e, const PlatformMotion& p, bool damps_first) {
  if (e.moored.present)
    platform_on_laws(e, p, damps_first);
  else
    platform_on_spring(e, p);
}

/// The platform's solo events up to the pair events: half a time step, drag first.
GEM_HD inline void platform_events_before(const Events& e, const Drive& drive, const PlatformMotion& p) {
  if (!e.platform_present) return;
  const PlatformSpeed before{p.velocity, p.spin};
  platform_in_water(e, drive, p);
  platform_in_wind(e, drive, p);
  take_water_along(e, {p.next, p.position, p.velocity, p.spin, p.drag_book}, before);
  platform_on_mooring(e, p, true);
}

/// The platform's solo events after the pair events: half a time step, mooring first.
GEM_HD inline void platform_events_after(const Events& e, const Drive& drive, const PlatformMotion& p) {
  if (!e.platform_present) return;
  platform_on_mooring(e, p, false);
  const PlatformSpeed before{p.velocity, p.spin};
  platform_in_wind(e, drive, p);
  platform_in_water(e, drive, p);
  take_water_along(e, {p.next, p.position, p.velocity, p.spin, p.drag_book}, before);
}

/// The platform under heading control.
struct PlatformYaw {
  double inertia;  // [kg m2]
  const Rotation& rotation;
  Vec2 position;   // [m]
  Vec2& velocity;  // [m/s]
  double& spin;    // [rad/s]
  Quantity& book;
};

/// Half a time step of heading control: before the pair events with `damps_first`, else at the end of the time step.
GEM_HD inline void steer_platform(const Events& e, const Drive& drive, const PlatformYaw& p, bool damps_first) {
  if (!e.platform_present || !e.heading.present()) return;
  const double before = p.spin;
  if (damps_first) p.spin *= e.heading.decay;
  p.spin += e.heading.half_step * heading_moment(e.heading.moment, p.rotation, drive.water) / p.inertia;
  if (!damps_first) p.spin *= e.heading.decay;
  const double twist = p.inertia * (p.spin - before);
  p.book.angular_momentum += twist;
  p.book.energy += 0.5 * twist * (p.spin + before);
  take_water_along(e, {p.rotation, p.position, p.velocity, p.spin, p.book}, {p.velocity, before});
}

/// The platform and the books of what pushes it from outside.
struct PushedPlatform {
  double mass, inertia;  // [kg], [kg m2]
  Vec2 position;         // [m]
  const Rotation& rotation;
  Vec2& velocity;  // [m/s]
  double& spin;    // [rad/s]
  Quantity& work;  // its energy
  Quantity& push;  // its momentum
};

/// Books a change of the platform's motion from `velocity` and `spin`.
GEM_HD inline void book_push(const PushedPlatform& p, Vec2 velocity, double spin) {
  const Vec2 impulse = p.mass * (p.velocity - velocity);
  const double twist = p.inertia * (p.spin - spin);
  p.push.momentum += impulse;
  p.push.angular_momentum += cross(p.position, impulse) + twist;
  p.work.energy += 0.5 * dot(impulse, p.velocity + velocity) + 0.5 * twist * (p.spin + spin);
}

/// Leads a ship in transit: before all other events of the time step. `turns`: its yaw is free.
GEM_HD inline void tow_platform(const Events& e, const Drive& drive, const PushedPlatform& p, bool turns) {
  if (!(e.tow_rate > 0.0)) return;
  const Vec2 velocity = p.velocity;
  const double spin = p.spin;
  p.velocity = e.thrust.present() ? tow_across(drive.tow, p.position, e.tow_rate, e.thrust.course, velocity)
                                  : tow_velocity(drive.tow, p.position, e.tow_rate);
  if (turns) p.spin = tow_spin(drive.tow, p.rotation, e.tow_rate);
  book_push(p, velocity, spin);
}

/// Half a time step of the thrust of a ship in transit: after the tow, and at the end of the time step.
GEM_HD inline void thrust_platform(const Events& e, const Drive& drive, const PushedPlatform& p) {
  if (!e.thrust.present()) return;
  const Vec2 velocity = p.velocity;
  const double speed = dot(e.thrust.course, velocity - drive.water);
  p.velocity += (speed_under_thrust(e.thrust, speed) - speed) * e.thrust.course;
  book_push(p, velocity, p.spin);
}

/// The platform under dynamic positioning.
struct PlatformOnDp {
  double mass, inertia;  // [kg], [kg m2]
  Vec2 position;         // [m]
  const Rotation& rotation;
  Vec2& velocity;   // [m/s]
  double& spin;     // [rad/s]
  Quantity& work;   // its energy
  Quantity& push;   // its momentum
  Quantity& water;  // what the water gives
  DpState& state;
};

/// Half a time step of the thrust that is held through it.
GEM_HD inline void push_by_thrusters(const Events& e, const PlatformOnDp& p) {
  const double half_step = 0.5 * e.dt;
  const Vec2 velocity = p.velocity;
  const double spin = p.spin;
  const ShipForce& force = p.state.given;
  p.velocity += (half_step / p.mass) * rotate(p.rotation, {force.surge, force.sway});
  p.spin += half_step * force.yaw / p.inertia;
  const Vec2 impulse = p.mass * (p.velocity - velocity);
  const double twist = p.inertia * (p.spin - spin);
  p.push.momentum += impulse;
  p.push.angular_momentum += cross(p.position, impulse) + twist;
  p.work.energy += 0.5 * dot(impulse, p.velocity + velocity) + 0.5 * twist * (p.spin + spin);
  take_water_along(e, {p.rotation, p.position, p.velocity, p.spin, p.water}, {velocity, spin});
}

/// Half a time step of dynamic positioning: before all other events of the time step with `commands`, which sets the
/// thrust, else after them.
GEM_HD inline void hold_station(const Events& e, const Drive& drive, const PlatformOnDp& p, bool commands) {
  if (!e.platform_present || !e.dp) return;
  if (commands) dp_command(*e.dp, {p.position, p.velocity, p.rotation, p.spin, drive.water}, p.state);
  push_by_thrusters(e, p);
}

/// A position repair of the platform.
struct PlatformShift {
  Vec2 position, shift;     // before it, and by how much [m]
  Rotation rotation, next;  // before and after it
};

/// Energy stored in the mooring of a platform at rest [J].
GEM_HD inline double mooring_energy(const Events& e, Vec2 position, Rotation q, LineSet broken) {
  if (e.moored.present) return mooring_pull(e.moored, position, q, broken).energy;
  const Vec2 offset = position - e.anchor;
  return 0.5 * e.mooring.stiffness_N_per_m * dot(offset, offset);
}

/// Books the change of mooring energy and angular momentum when the platform is shifted.
GEM_HD inline void book_platform_shift(const Events& e, double mass, Vec2 velocity, LineSet broken,
                                       const PlatformShift& s, Quantity& book) {
  book.angular_momentum += mass * cross(s.shift, velocity);
  if (e.moored.present) {
    book.energy +=
        mooring_energy(e, s.position + s.shift, s.next, broken) - mooring_energy(e, s.position, s.rotation, broken);
    return;
  }
  const Vec2 offset = s.position - e.anchor;
  book.energy += e.mooring.stiffness_N_per_m * (dot(offset, s.shift) + 0.5 * dot(s.shift, s.shift));
}

// ---- pair events

/// Impulse limit of a point without a limit [N s].
constexpr double no_cap = 1e300;

/// Friction coefficient of a pair: floe on platform, or ice on ice.
GEM_HD inline double friction_of_pair(const Events& e, bool with_platform) {
  return with_platform ? e.ice.friction_structure : e.ice.friction_ice;
}

/// Crushing parameters of the ice of a pair, `thickness` [m].
GEM_HD inline CrushingIce crushing_ice(const Events& e, double thickness) {
  return {e.ice.crushing_pressure_Pa, e.ice.pressure_area_exponent, thickness};
}

/// Impulse of one point from the normal velocity u_n and tangential velocity u_t without it; `target`: smallest normal
/// velocity after the event [m/s].
GEM_HD inline ContactImpulse pair_impulse(const Events& e, const ContactCompliance& compliance, double friction,
                                          double u_n, double u_t, double target) {
  if (!(friction > 0.0)) return {impact_frictionless(compliance.nn, u_n, target), 0.0};
  if (e.contact.friction_law == FrictionLaw::fixed_direction)
    return impact_fixed_direction(compliance, u_n, u_t, target, friction);
  return impact_one_step(compliance, u_n, u_t, target, friction);
}

/// Separating speed that the elastic stress of one point asks for, limited by crushing [m/s]. `depth` and `width` of
/// the contact and `thickness` of its ice in [m]; `compliance` is 1/effective mass [1/kg].
GEM_HD inline double static_stress_speed(const Events& e, double depth, double compliance, double width,
                                         double thickness) {
  const double asked = elastic_separating_speed(e.contact.elastic_stiffness_N_per_m, depth, 1.0 / compliance, e.dt);
  const CrushingIce ice = crushing_ice(e, thickness);
  if (asked < crushing_force_at_least(ice, width) * e.dt * compliance) return asked;
  const double cap = crushing_force(ice, width) * e.dt * compliance;
  return asked < cap ? asked : cap;
}

/// The force that crushes a body across its whole size w is P0 h^(1+ex) w^(1+ex): its powers, evaluated once per run.
struct CrushingPowers {
  double thickness = 0.0;  // h^(1+ex)
  double width = 0.0;      // w^(1+ex), with w the root of the area
};

/// The powers of a body of `thickness` [m] and `area` [m2].
GEM_HD inline CrushingPowers crushing_powers(const Events& e, double thickness, double area) {
  const double exponent = 1.0 + e.ice.pressure_area_exponent;
  return {strict::power(thickness, exponent), strict::power(std::sqrt(area), exponent)};
}

/// Largest impulse of one of `points` points of a contact in a time step [N s]: the impulse that crushes the smaller
/// body across its whole size. `thickness`: the power of the ice that crushes; `width`: of the smaller body.
/// `ice_crushes`: one of the bodies is a floe.
GEM_HD inline double largest_impulse(const Events& e, bool ice_crushes, double thickness, double width, int points) {
  if (!e.contact.crushing_limit || !ice_crushes) return no_cap;
  return e.dt / points * e.ice.crushing_pressure_Pa * thickness * width;
}

}  // namespace gem
