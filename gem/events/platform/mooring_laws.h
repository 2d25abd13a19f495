// Moorings beyond the linear one: tables of force over offset, lines, and stiffness and damping of the yaw.
//
//   table     radial:  F = -f(r) e,  U = U(r)
//             by direction, between the neighbours d_1 and d_2 of e:
//               U = U_1(r) + w (U_2(r) - U_1(r)),   w = s^2 (3 - 2 s),   s = (d_1 x e) / (d_1 x e + e x d_2)
//               F = -(f_1 + w (f_2 - f_1)) e - (dU/dphi / r) n
//   catenary  F = sum over lines of  H(d) t,   N = sum of arm x H(d) t,   U = sum of the integrals of H
//   failure   a line breaks at the end of a time step in which its tension at the fairlead is above its strength
//   yaw       N = -k_yaw psi,  U = k_yaw psi^2 / 2        damping   v' = v e^(-c t / M),  likewise for the spin
//
//   r, e   offset from the anchor and its direction [m], [-]    n     e turned left
//   d, t   from a fairlead to its anchor: distance and direction, seen from above [m], [-]
//   H      horizontal tension of a line over that distance [N]  arm   from the platform's centre to the fairlead [m]
//   psi    yaw in (-pi, pi], the rest is at 0 [rad]             w, s  shares: F is smooth where e passes d_1 or d_2
//
// Every force is minus the gradient of U, so a swing keeps its energy. Half a time step of h = dt / 2 is a drift of
// h / 2, a kick of h and a drift of h / 2. The yaw turns between the kicks of two half steps. Damping stands outside,
// first in the first half, last in the second. All of this is symmetric in time and symplectic without damping: the
// error is of second order, (omega h)^2 / 24 of the period of a linear swing, and no energy is lost or won on average.
// Linear surge and sway keep their exact solution (mooring.h), but not with added mass: a kick then takes the water
// along. A line that breaks takes its energy out of the books at once and pulls no more; so the time of the break is
// exact to one time step.
//
// Range: quasi-static moorings. Neglected: mass, drag and seabed friction of lines, and time that they need to settle.
#pragma once

#include <cstdint>

#include "gem/base/strict_math.h"
#include "gem/base/vec2.h"
#include "gem/events/platform/added_mass.h"
#include "gem/events/platform/force_curve.h"
#include "gem/events/platform/mooring.h"

namespace gem {

/// A direction of a table, or a line.
struct MooringBranch {
  Vec2 direction;         // table: of the offset, unit vector
  Vec2 anchor, fairlead;  // line: in world axes, and from the platform's centre in body axes [m]
  double strength = 0.0;  // line: it breaks with more tension; 0: never [N]
  std::int32_t first_knot = 0, knots = 0;
};

/// The branches of a mooring and their curves, in memory of the machine that reads them. Directions ascend.
struct MooringView {
  const MooringBranch* branch = nullptr;
  const CurveKnot* knot = nullptr;
  std::int32_t branches = 0, knots = 0;
};

/// Set of lines, one bit for each.
using LineSet = std::uint64_t;
constexpr std::int32_t lines_maximum = 64;

/// Constants of the mooring of a run.
struct MooringLaws {
  bool present = false;  // anything beyond the linear mooring of surge and sway
  MooringLaw law = MooringLaw::linear;
  Vec2 anchor;                                  // [m]
  double stiffness = 0.0, yaw_stiffness = 0.0;  // linear law [N/m]; [N m/rad]
  double step = 0.0;                            // half a time step [s]
  MooringFlow flow;                             // linear law: over `step`
  double decay = 1.0, yaw_decay = 1.0;          // of the velocities over `step`
  AddedMass added_mass;
  MooringView view;
};

/// What a mooring does to the platform.
struct MooringPull {
  Vec2 force;           // [N]
  double moment = 0.0;  // about the platform's centre [N m]
  double energy = 0.0;  // stored in the mooring [J]
};

GEM_HD inline CurvePoint branch_at(const MooringView& view, const MooringBranch& branch, double x) {
  return curve_at(view.knot + branch.first_knot, branch.knots, x);
}

/// Pull of a table at `offset` from the anchor [m].
GEM_HD inline MooringPull table_pull(const MooringView& view, Vec2 offset) {
  const double r = length(offset);
  if (!(r > 0.0)) return {};
  const Vec2 e = (1.0 / r) * offset;
  if (view.branches == 1) {
    const CurvePoint at = branch_at(view, view.branch[0], r);
    return {-at.force * e, 0.0, at.energy};
  }
  std::int32_t k = 0, next = 1;
  double a = 0.0, b = 0.0;
  for (; k < view.branches; ++k) {
    next = k + 1 < view.branches ? k + 1 : 0;
    a = cross(view.branch[k].direction, e);
    b = cross(e, view.branch[next].direction);
    if (a >= 0.0 && b > 0.0) break;
  }
  if (k == view.branches) return {};  // only if e is not finite
  const CurvePoint p = branch_at(view, view.branch[k], r), q = branch_at(view, view.branch[next], r);
  const double s = a / (a + b), w = s * s * (3.0 - 2.0 * s);
  const double s_slope = cross(view.branch[k].direction, view.branch[next].direction) / ((a + b) * (a + b));
  const double turning = 6.0 * s * (1.0 - s) * s_slope * (q.energy - p.energy) / r;
  return {-(p.force + w * (q.force - p.force)) * e - turning * turned_left(e), 0.0,
          p.energy + w * (q.energy - p.energy)};
}

/// The vector from a line's fairlead to its anchor, and its arm [m].
struct LineReach {
  Vec2 reach, arm;
};
GEM_HD inline LineReach line_reach(const MooringBranch& line, Vec2 position, Rotation q) {
  const Vec2 arm = rotate(q, line.fairlead);
  return {line.anchor - (position + arm), arm};
}

GEM_HD inline bool is_broken(LineSet broken, std::int32_t line) { return (broken >> line & 1) != 0; }

/// Tension of a line at its fairlead, where it is largest [N].
GEM_HD inline double line_tension(const MooringView& view, std::int32_t line, Vec2 position, Rotation q) {
  return branch_at(view, view.branch[line], length(line_reach(view.branch[line], position, q).reach)).beside;
}

/// The broken lines after those that have too much tension have broken too.
GEM_HD inline LineSet broken_after(const MooringLaws& m, Vec2 position, Rotation q, LineSet broken) {
  if (m.law != MooringLaw::catenary) return broken;
  for (std::int32_t k = 0; k < m.view.branches; ++k) {
    const double strength = m.view.branch[k].strength;
    if (strength > 0.0 && line_tension(m.view, k, position, q) > strength) broken |= LineSet{1} << k;
  }
  return broken;
}

/// Pull of all lines that are not broken.
GEM_HD inline MooringPull lines_pull(const MooringView& view, Vec2 position, Rotation q, LineSet broken) {
  MooringPull sum;
  for (std::int32_t k = 0; k < view.branches; ++k) {
    if (is_broken(broken, k)) continue;
    const LineReach line = line_reach(view.branch[k], position, q);
    const double distance = length(line.reach);
    if (!(distance > 0.0)) continue;
    const CurvePoint at = branch_at(view, view.branch[k], distance);
    const Vec2 force = (at.force / distance) * line.reach;
    sum.force += force;
    sum.moment += cross(line.arm, force);
    sum.energy += at.energy;
  }
  return sum;
}

/// Pull of the mooring on the platform at a place [m] and rotation.
GEM_HD inline MooringPull mooring_pull(const MooringLaws& m, Vec2 position, Rotation q, LineSet broken) {
  MooringPull pull;
  const Vec2 offset = position - m.anchor;
  if (m.law == MooringLaw::table) {
    pull = table_pull(m.view, offset);
  } else if (m.law == MooringLaw::catenary) {
    pull = lines_pull(m.view, position, q, broken);
  } else {
    pull = {-m.stiffness * offset, 0.0, 0.5 * m.stiffness * dot(offset, offset)};
  }
  if (m.yaw_stiffness > 0.0) {
    const double yaw = strict::angle_of(q);
    pull.moment -= m.yaw_stiffness * yaw;
    pull.energy += 0.5 * m.yaw_stiffness * yaw * yaw;
  }
  return pull;
}

/// What the mooring moves, with its inertia. The yaw stays as it is.
struct Moored {
  Vec2& position;                // [m]
  Vec2& velocity;                // [m/s]
  double& spin;                  // [rad/s]
  double mass, inverse_inertia;  // [kg], [1/(kg m2)]; inverse 0: the yaw is locked
};

/// The water takes its part of a change from `before`. Returns what it gives.
GEM_HD inline Quantity take_water_along(const AddedMass& a, const Moored& p, Rotation q, const PlatformSpeed& before) {
  if (!a.present) return {};
  const PlatformSpeed alone{p.velocity, p.spin}, after = with_water(a, q, before, alone);
  p.velocity = after.velocity;
  p.spin = after.spin;
  return given_by_water(a, p.position, alone, after);
}

/// Half a time step on the mooring, without its damping. Returns what the water gives.
GEM_HD inline Quantity swing(const MooringLaws& m, const Moored& p, Rotation q, LineSet broken) {
  if (m.law == MooringLaw::linear && !m.added_mass.present) {
    Vec2 offset = p.position - m.anchor;
    p.spin += m.step * p.inverse_inertia * mooring_pull(m, p.position, q, broken).moment;
    apply(m.flow, offset, p.velocity);
    p.position = m.anchor + offset;
    return {};
  }
  p.position += (0.5 * m.step) * p.velocity;
  const PlatformSpeed before{p.velocity, p.spin};
  const MooringPull pull = mooring_pull(m, p.position, q, broken);
  p.velocity += (m.step / p.mass) * pull.force;
  p.spin += m.step * p.inverse_inertia * pull.moment;
  const Quantity water = take_water_along(m.added_mass, p, q, before);
  p.position += (0.5 * m.step) * p.velocity;
  return water;
}

/// Half a time step of linear damping. Returns what the water gives.
GEM_HD inline Quantity damp(const MooringLaws& m, const Moored& p, Rotation q) {
  const PlatformSpeed before{p.velocity, p.spin};
  p.velocity = m.decay * p.velocity;
  if (p.inverse_inertia > 0.0) p.spin *= m.yaw_decay;
  return take_water_along(m.added_mass, p, q, before);
}

}  // namespace gem
