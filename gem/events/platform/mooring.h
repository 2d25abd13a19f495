// Linear mooring of the platform, exact for any duration: a rotation in phase space.
//
//   M x'' + c x' + k x = 0,  x from the anchor:   (x, v)' = [a11 a12; a21 a22] (x, v)
//   undamped:  a11 = a22 = cos(wt), a12 = sin(wt)/w, a21 = -w sin(wt),   w = sqrt(k/M)
//
//   k  stiffness, equal in x and y [N/m]    M  platform mass [kg]    zeta  damping ratio c / (2 sqrt(k M)), < 1 [-]
//
// The coefficients are computed once per run, so a time step needs no trigonometry. k = 0 gives free drift.
#pragma once

#include <cmath>
#include <numbers>

#include "gem/base/vec2.h"

namespace gem {

enum class MooringLaw { linear, table, catenary };

struct MooringDef {
  double stiffness_N_per_m = 5e5;  ///< equal in x and y; 0: unmoored
  double damping_ratio = 0.0;
  MooringLaw law = MooringLaw::linear;  ///< of surge and sway; the others are in mooring_laws.h
  double damping_N_s_per_m = 0.0;       ///< linear, in surge and sway, beside damping_ratio
  double yaw_stiffness_N_m_per_rad = 0.0;
  double yaw_damping_N_m_s_per_rad = 0.0;
};

/// Coefficients of the exact solution for one duration: the first letter says what they give, the second from what.
struct MooringFlow {
  double xx = 1.0;  // offset from offset [-]
  double xv = 0.0;  // offset from velocity [s]
  double vx = 0.0;  // velocity from offset [1/s]
  double vv = 1.0;  // velocity from velocity [-]
};

/// 2 pi sqrt(M / k) [s], without damping and added mass; 0 without mooring. Host only.
inline double natural_period(double stiffness, double mass) {
  return stiffness > 0.0 ? 2.0 * std::numbers::pi * std::sqrt(mass / stiffness) : 0.0;
}

/// Coefficients for `stiffness` [N/m], `mass` [kg] and `duration` [s]. Host only, once per run.
inline MooringFlow mooring_flow(double stiffness, double mass, double damping_ratio, double duration) {
  if (!(stiffness > 0.0)) return {1.0, duration, 0.0, 1.0};
  const double natural = std::sqrt(stiffness / mass);
  const double damped = natural * std::sqrt(1.0 - damping_ratio * damping_ratio);
  const double rate = damping_ratio * natural;
  const double decay = std::exp(-rate * duration);
  const double cosine = std::cos(damped * duration), sine = std::sin(damped * duration);
  return {decay * (cosine + rate / damped * sine), decay * sine / damped, -decay * natural * natural / damped * sine,
          decay * (cosine - rate / damped * sine)};
}

/// Advances offset from the anchor [m] and velocity [m/s] by one duration.
GEM_HD constexpr void apply(const MooringFlow& flow, Vec2& offset, Vec2& velocity) {
  const Vec2 moved = flow.xx * offset + flow.xv * velocity;
  velocity = flow.vx * offset + flow.vv * velocity;
  offset = moved;
}

}  // namespace gem
