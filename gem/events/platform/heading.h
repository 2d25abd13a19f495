// Heading control: turns the platform's bow against the current, as thrusters or a crew with tugs do.
//
//   I r' = M - C r,    M = K sin e  for |e| <= 90 degrees, beyond that K with the sign of e
//
//   e  angle from the platform's x axis to the direction that the water flows to [rad]; a ship's bow points to -x, so
//      at e = 0 it meets what the current brings       K  largest moment [N m]     C  damping of the yaw rate [N m s]
//   I  moment of inertia [kg m2]                       r  yaw rate [rad/s]
//
// For small e a spring of K per radian with damping; the sine is the usual error of attitude control (Bullo and Murray
// 1995), which knows no jump at half a turn and needs no trigonometry. Half a time step acts before the pair events,
// with the yaw at the start of the time step, and half at its end, with the yaw there: of second order in dt. The
// damping is exact. Without current there is no direction and M = 0. Neglected: limits of rate, delay, forces of surge
// and sway that real thrusters give with a moment.
#pragma once

#include "gem/base/vec2.h"

namespace gem {

struct HeadingDef {
  double moment_N_m = 0.0;  ///< K; 0: no control
  double damping_N_m_s = 0.0;
};

/// Constants of the law in a run.
struct HeadingLaw {
  double moment = 0.0;     // [N m]
  double decay = 1.0;      // e^(-C dt / 2 I)
  double half_step = 0.0;  // [s]

  GEM_HD constexpr bool present() const { return moment > 0.0 || decay < 1.0; }
};

/// Work of the control over half a turn, over K [-]: 1 + pi / 2.
constexpr double half_turn_work = 2.5707963267948966;

/// M for a platform with yaw `q` in water of velocity `water`.
GEM_HD inline double heading_moment(double moment, Rotation q, Vec2 water) {
  const double speed = length(water);
  if (!(speed > 0.0)) return 0.0;
  const Vec2 ahead{q.cosine, q.sine};
  const double sine = cross(ahead, water) / speed;
  if (dot(ahead, water) >= 0.0) return moment * sine;
  return sine < 0.0 ? -moment : moment;
}

/// Most work of the control on a platform at rest with yaw `start` until its bow meets the water, over K [-]. Beyond a
/// right angle that of half a turn.
GEM_HD inline double heading_work(Rotation start, Vec2 water) {
  const double speed = length(water);
  if (!(speed > 0.0)) return 0.0;
  const double cosine = dot({start.cosine, start.sine}, water) / speed;
  return cosine >= 0.0 ? 1.0 - cosine : half_turn_work;
}

}  // namespace gem
