// Dynamic positioning: thrusters hold the platform at a set point. A PID law of surge, sway and yaw, and the allocation
// of its demand to thrusters with limits.
//
//   filter      y' = (x - y) / T_f  for each of position, yaw error, velocity and yaw rate; exact for a constant x
//   demand      tau = -K_p e - K_d nu - K_i R^T z,   z' = R e
//   allocation  least  sum |u_i|^2 / U_i^2  with  sum B_i u_i = tau:   u_i = U_i^2 B_i^T (sum U_j^2 B_j B_j^T)^-1 tau
//
//   e    offset from the set point in the ship's axes: surge, sway [m], yaw [rad]      nu  velocity likewise
//   R    from the ship's axes to the world's            z  integral of the offset [m s], [rad s]
//   K    gains by surge, sway, yaw                      T_f  time constant of the low-pass [s]
//   u_i  thrust of thruster i in the ship's axes [N]    U_i  its largest thrust [N]
//   B_i  from thrust to force and moment about the platform's centre
//
// Gains from a natural period T and a damping ratio zeta: K_p = M (2 pi / T)^2, K_d = 2 zeta M 2 pi / T, with the mass
// or moment of inertia of the platform; K_i = K_p / T_i. The integral stands in the world's axes: a load that comes
// from one direction keeps its part of it while the ship turns. It does not grow where the thrusters give less than is
// asked for and growing would ask for more (conditional integration). Thrusters beyond their limit are cut to it and
// the rest of the demand is given to the others, until none is beyond (redistributed pseudo-inverse). Then no thrust
// changes faster than its rate limit. The thrust is found at the start of a time step and held through it: half of its
// impulse acts before the pair events, half after them.
//
// Sources: Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control (2nd ed., 2021), ch. 12 and 15; Johansen
// and Fossen, Control allocation - a survey, Automatica 49 (2013).
// Neglected: losses of thrust (hull, wake, ice in the propeller), time to turn an azimuth thruster beside its rate
// limit, forbidden sectors, noise, feed-forward of wind and ice, priority of the heading when all are at their limits.
#pragma once

#include <cmath>
#include <cstdint>

#include "gem/base/strict_math.h"
#include "gem/base/vec2.h"

namespace gem {

constexpr std::int32_t thrusters_maximum = 16;

/// Numbers of surge, sway and yaw in the ship's axes.
struct ShipForce {
  double surge = 0.0, sway = 0.0;  // [N]
  double yaw = 0.0;                // [N m]
};

/// Gains of one degree of freedom: [N/m], [N s/m], [N/(m s)]; of the yaw with moments and radians.
struct DpGain {
  double proportional = 0.0, derivative = 0.0, integral = 0.0;
};

/// Constants of one thruster.
struct DpThruster {
  Vec2 position;             // from the platform's centre, in the ship's axes [m]
  Vec2 axis;                 // direction of its thrust, unless it is azimuth
  double maximum = 0.0;      // largest thrust [N]
  double reverse = 0.0;      // largest thrust against `axis` [N]
  double step = 0.0;         // largest change in one time step [N]
  std::int32_t azimuth = 0;  // 1: in any direction
};

/// Constants of the law in a run.
struct DpLaw {
  Vec2 place;              // set point [m]
  Rotation heading;        // set point of the yaw
  bool follows = false;    // the set point of the yaw counts from the direction that the water flows to
  DpGain gain[3];          // surge, sway, yaw
  double keep = 0.0;       // e^(-dt / T_f); 0: no filter
  double dt = 0.0;         // [s]
  double arm = 1.0;        // length by which moments are scaled [m]
  double tolerance = 0.0;  // shortfall that counts as none [N]
  std::int32_t thrusters = 0;
  DpThruster thruster[thrusters_maximum];
};

/// What the law keeps from one time step to the next, and what it gave in the last one.
struct DpState {
  std::int64_t steps = 0;          // made; 0: the filter has not seen anything
  std::uint64_t at_limit = 0;      // a bit for each thruster at its largest thrust or its rate limit
  Vec2 offset, velocity;           // filtered, in the world's axes [m], [m/s]
  double yaw = 0.0, spin = 0.0;    // filtered error and rate [rad], [rad/s]
  Vec2 integral;                   // z [m s]
  double yaw_integral = 0.0;       // [rad s]
  double yaw_offset = 0.0;         // without the filter [rad]
  ShipForce demand, given;         // asked for, and sum of the thrusts
  Vec2 thrust[thrusters_maximum];  // in the ship's axes [N]
};

/// What the law measures.
struct DpMeasured {
  Vec2 position, velocity;  // [m], [m/s]
  Rotation rotation;
  double spin = 0.0;  // [rad/s]
  Vec2 water;         // velocity of the water [m/s]
};

GEM_HD inline Vec2 to_ship(Rotation q, Vec2 a) { return rotate({q.cosine, -q.sine}, a); }

/// Product of two rotations: q, then p.
GEM_HD constexpr Rotation after(Rotation p, Rotation q) {
  return {p.cosine * q.cosine - p.sine * q.sine, p.sine * q.cosine + p.cosine * q.sine};
}

/// Yaw of the set point. In still water a set point that follows the drift counts from the x axis.
GEM_HD inline Rotation dp_heading(const DpLaw& law, Vec2 water) {
  const double speed = length(water);
  if (!law.follows || !(speed > 0.0)) return law.heading;
  return after({water.x / speed, water.y / speed}, law.heading);
}

/// Yaw error in (-pi, pi] [rad].
GEM_HD inline double dp_yaw_error(const DpLaw& law, Rotation q, Vec2 water) {
  const Rotation set = dp_heading(law, water);
  return strict::angle_of(after({set.cosine, -set.sine}, q));
}

/// An angle less than two turns off, in [-pi, pi].
GEM_HD inline double within_half_turn(double angle) {
  constexpr double half = 0.5 * strict::two_pi;
  return angle > half ? angle - strict::two_pi : angle < -half ? angle + strict::two_pi : angle;
}

/// The filter over one time step.
GEM_HD inline void dp_filter(const DpLaw& law, const DpMeasured& m, DpState& s) {
  const Vec2 offset = m.position - law.place;
  s.yaw_offset = dp_yaw_error(law, m.rotation, m.water);
  const double keep = s.steps > 0 ? law.keep : 0.0;
  s.offset = offset + keep * (s.offset - offset);
  s.velocity = m.velocity + keep * (s.velocity - m.velocity);
  s.yaw = within_half_turn(s.yaw_offset + keep * within_half_turn(s.yaw - s.yaw_offset));
  s.spin = m.spin + keep * (s.spin - m.spin);
}

/// tau for the filtered motion of a ship turned by `q`.
GEM_HD inline ShipForce dp_demand(const DpLaw& law, const DpState& s, Rotation q) {
  const Vec2 e = to_ship(q, s.offset), v = to_ship(q, s.velocity), z = to_ship(q, s.integral);
  const DpGain &x = law.gain[0], &y = law.gain[1], &n = law.gain[2];
  return {-(x.proportional * e.x) - x.derivative * v.x - x.integral * z.x,
          -(y.proportional * e.y) - y.derivative * v.y - y.integral * z.y,
          -(n.proportional * s.yaw) - n.derivative * s.spin - n.integral * s.yaw_integral};
}

/// Force and moment of a thrust.
GEM_HD inline ShipForce dp_force_of(const DpThruster& t, Vec2 thrust) {
  return {thrust.x, thrust.y, cross(t.position, thrust)};
}

/// Symmetric matrix of the allocation, moments over `arm`, as its lower triangle by rows.
struct DpMatrix {
  double xx = 0.0, yx = 0.0, yy = 0.0, nx = 0.0, ny = 0.0, nn = 0.0;
};

/// Adds w b b^T for one direction of thrust, b = (axis, lever).
GEM_HD inline void dp_add_direction(DpMatrix& g, double w, Vec2 axis, double lever) {
  g.xx += w * axis.x * axis.x;
  g.yx += w * axis.y * axis.x;
  g.yy += w * axis.y * axis.y;
  g.nx += w * lever * axis.x;
  g.ny += w * lever * axis.y;
  g.nn += w * lever * lever;
}

/// Adds U^2 B B^T of a thruster.
GEM_HD inline void dp_add(DpMatrix& g, const DpThruster& t, double arm) {
  const double w = t.maximum * t.maximum;
  if (t.azimuth) {
    dp_add_direction(g, w, {1.0, 0.0}, -t.position.y / arm);
    dp_add_direction(g, w, {0.0, 1.0}, t.position.x / arm);
  } else {
    dp_add_direction(g, w, t.axis, cross(t.position, t.axis) / arm);
  }
}

/// Solution of g x = r by L D L^T. A direction that no thruster can push gets nothing.
GEM_HD inline ShipForce dp_solve(const DpMatrix& g, const ShipForce& r) {
  constexpr double rank = 1e-10;  // of a pivot against its diagonal: far above rounding, far below real layouts
  const double dx = g.xx > 0.0 ? 1.0 / g.xx : 0.0;
  const double lyx = dx * g.yx, lnx = dx * g.nx;
  const double py = g.yy - lyx * g.yx, dy = py > rank * g.yy ? 1.0 / py : 0.0;
  const double below = g.ny - lnx * g.yx, lny = dy * below;
  const double pn = g.nn - lnx * g.nx - lny * below, dn = pn > rank * g.nn ? 1.0 / pn : 0.0;
  const double a = r.surge, b = r.sway - lyx * a, c = r.yaw - lnx * a - lny * b;
  const double z = dn * c, y = dy * b - lny * z, x = dx * a - lyx * y - lnx * z;
  return {dx > 0.0 ? x : 0.0, dy > 0.0 ? y : 0.0, z};
}

/// Thrust of the pseudo-inverse for the solution `x` of the allocation's matrix.
GEM_HD inline Vec2 dp_share(const DpThruster& t, const ShipForce& x, double arm) {
  const double w = t.maximum * t.maximum;
  const Vec2 pull{x.surge - x.yaw * t.position.y / arm, x.sway + x.yaw * t.position.x / arm};
  return t.azimuth ? w * pull : (w * dot(t.axis, pull)) * t.axis;
}

/// The thrust cut to what the thruster can give.
GEM_HD inline Vec2 dp_cut(const DpThruster& t, Vec2 thrust) {
  if (t.azimuth) {
    const double size = length(thrust);
    return size > t.maximum ? (t.maximum / size) * thrust : thrust;
  }
  const double along = dot(t.axis, thrust);
  return along > t.maximum ? t.maximum * t.axis : along < -t.reverse ? -t.reverse * t.axis : thrust;
}

GEM_HD inline bool dp_is_beyond(const DpThruster& t, Vec2 thrust) {
  if (t.azimuth) return length(thrust) > t.maximum;
  const double along = dot(t.axis, thrust);
  return along > t.maximum || along < -t.reverse;
}

/// Writes the thrusts that give `demand`, or as much of it as they can. Returns the thrusters at their largest thrust,
/// a bit for each.
GEM_HD inline std::uint64_t dp_allocate(const DpLaw& law, const ShipForce& demand, Vec2* thrust) {
  std::uint64_t cut = 0;
  ShipForce rest{demand.surge, demand.sway, demand.yaw / law.arm};  // for the thrusters that are not cut
  for (std::int32_t round = 0; round < law.thrusters; ++round) {
    DpMatrix g;
    for (std::int32_t i = 0; i < law.thrusters; ++i)
      if (!(cut >> i & 1)) dp_add(g, law.thruster[i], law.arm);
    const ShipForce x = dp_solve(g, rest);
    std::uint64_t beyond = 0;
    for (std::int32_t i = 0; i < law.thrusters; ++i) {
      if (cut >> i & 1) continue;
      const DpThruster& t = law.thruster[i];
      thrust[i] = dp_share(t, x, law.arm);
      if (!dp_is_beyond(t, thrust[i])) continue;
      thrust[i] = dp_cut(t, thrust[i]);
      beyond |= std::uint64_t{1} << i;
    }
    if (beyond == 0) break;
    for (std::int32_t i = 0; i < law.thrusters; ++i) {
      if (!(beyond >> i & 1)) continue;
      const ShipForce given = dp_force_of(law.thruster[i], thrust[i]);
      rest = {rest.surge - given.surge, rest.sway - given.sway, rest.yaw - given.yaw / law.arm};
    }
    cut |= beyond;
  }
  return cut;
}

/// The thrust that a thruster reaches in one time step from `now` towards `wanted`.
GEM_HD inline Vec2 dp_reached(const DpThruster& t, Vec2 now, Vec2 wanted) {
  const Vec2 change = wanted - now;
  const double size = length(change);
  return size > t.step ? now + (t.step / size) * change : wanted;
}

/// What the integral of one degree of freedom grows by in a time step: nothing where the thrusters give less than is
/// asked for and it would ask for more.
GEM_HD inline double dp_growth(const DpLaw& law, double error, double shortfall, double tolerance) {
  const bool short_of = shortfall > tolerance || shortfall < -tolerance;
  return short_of && shortfall * error < 0.0 ? 0.0 : law.dt * error;
}

GEM_HD inline void dp_integrate(const DpLaw& law, Rotation q, DpState& s) {
  const Vec2 e = to_ship(q, s.offset);
  const Vec2 more{dp_growth(law, e.x, s.demand.surge - s.given.surge, law.tolerance),
                  dp_growth(law, e.y, s.demand.sway - s.given.sway, law.tolerance)};
  s.integral += rotate(q, more);
  s.yaw_integral += dp_growth(law, s.yaw, s.demand.yaw - s.given.yaw, law.tolerance * law.arm);
}

/// Sets the thrusts of a time step from what is measured at its start.
GEM_HD inline void dp_command(const DpLaw& law, const DpMeasured& m, DpState& s) {
  dp_filter(law, m, s);
  s.demand = dp_demand(law, s, m.rotation);
  Vec2 wanted[thrusters_maximum];
  s.at_limit = dp_allocate(law, s.demand, wanted);
  s.given = {};
  for (std::int32_t i = 0; i < law.thrusters; ++i) {
    const DpThruster& t = law.thruster[i];
    const Vec2 reached = dp_reached(t, s.thrust[i], wanted[i]);
    if (reached.x != wanted[i].x || reached.y != wanted[i].y) s.at_limit |= std::uint64_t{1} << i;
    s.thrust[i] = reached;
    const ShipForce force = dp_force_of(t, reached);
    s.given = {s.given.surge + force.surge, s.given.sway + force.sway, s.given.yaw + force.yaw};
  }
  dp_integrate(law, m.rotation, s);
  ++s.steps;
}

}  // namespace gem
