// Water drag on a floe in a current, exact over a time step of any length.
//
//   quadratic   dw/dt = -k |w| w     w' = w / (1 + z),   z = k |w| dt,   path of w = (w / |w|) ln(1 + z) / k
//   linear      dw/dt = -w / tau     w' = w e^(-dt/tau),                 path of w = tau (w - w')
//
//   w   slip, current minus floe velocity [m/s]      k   (rho_w / m)(C_f W T / 2 + C_s A) [1/m]
//   The spin follows the same equation with the slip -omega and k in 1 (one per radian).
//
// Exact because the direction of w does not change. With a turning angle theta the force is turned from w, since the
// current below the boundary layer of the ice, which w is measured against, is turned from that at the ice (Ekman):
//
//   turned      dw/dt = -k |w| R(theta) w     z = k cos(theta) |w| dt,   w' = R(-a) w / (1 + z)
//               a = tan(theta) ln(1 + z)
//               path of w = w dt ln(1 + z) / z R(-a/2) sin(a/2) / (a/2)
//
//   theta  counter-clockwise [rad]; about 0.4 on the northern hemisphere (McPhee, J. Phys. Oceanogr. 9, 1979)
//
// Exact up to the turn of motion.h, that is for a < 0.5. The whole drag is turned, that on the edges too. Neglected:
// lift, wake of a neighbour, added mass.
#pragma once

#include "gem/base/strict_math.h"
#include "gem/base/vec2.h"
#include "gem/events/motion.h"

namespace gem {

enum class DragLaw { none, quadratic, linear };

/// The water moves with this velocity everywhere.
struct CurrentDef {
  Vec2 velocity_m_per_s = {0.25, 0.0};
};

/// Definition of the water drag on floes.
struct WaterDef {
  double density_kg_per_m3 = 1025.0;
  DragLaw drag_law = DragLaw::quadratic;
  double form_coefficient = 1.0;   ///< C_f, on sqrt(area) x draft
  double skin_coefficient = 5e-3;  ///< C_s, on the area
  double linear_time_s = 100.0;    ///< tau of the linear law
  bool spin_drag = true;           ///< the drag also slows the spin
  double turning_rad = 0.0;        ///< theta of the quadratic law
};

/// Slip after a time step, and the correction of its path.
struct DragSolution {
  Vec2 slip;             // after the time step [m/s]
  Vec2 path_correction;  // integral of the slip over the time step minus slip x dt [m]
};

struct SpinDragSolution {
  double spin = 0.0;              // [rad/s]
  double angle_correction = 0.0;  // [rad]
};

/// z of the quadratic law.
GEM_HD inline double drag_reach(double k, double speed, double dt) { return k * speed * dt; }

/// Factors of a slip in the quadratic law.
struct DragShares {
  double left;             // share of the slip after the time step [-]
  double path_correction;  // path correction per slip [s]
};

/// `log`: ln(1 + z), z > 0.
GEM_HD inline DragShares drag_shares(double z, double log, double dt) {
  const double left = 1.0 / (1.0 + z);
  return {left, dt * (log / z - left)};
}

GEM_HD inline DragSolution shared_out(DragShares shares, Vec2 slip) {
  return {shares.left * slip, shares.path_correction * slip};
}

GEM_HD inline SpinDragSolution shared_out(DragShares shares, double spin) {
  return {shares.left * spin, shares.path_correction * spin};
}

/// Quadratic law; `speed` is |slip|.
GEM_HD inline DragSolution drag_quadratic(double k, Vec2 slip, double speed, double dt) {
  const double z = drag_reach(k, speed, dt);
  if (!(z > 0.0)) return {slip, {}};
  return shared_out(drag_shares(z, strict::log1p(z), dt), slip);
}

/// The turning angle, by its cosine and tangent.
struct Turning {
  double cosine = 1.0, tangent = 0.0;
};

/// Host only, once per run.
inline Turning turning_of(double angle) {
  const Rotation q = strict::rotation_of_angle(angle);
  return {q.cosine, q.sine / q.cosine};
}

/// Quadratic law with a force that is turned from the slip; `speed` is |slip|.
GEM_HD inline DragSolution drag_turned(double k, Turning turning, Vec2 slip, double speed, double dt) {
  const double z = drag_reach(k * turning.cosine, speed, dt);
  if (!(z > 0.0)) return {slip, {}};
  const double logarithm = strict::log1p(z);
  const double angle = turning.tangent * logarithm;
  const Vec2 after = rotate(turned({}, -angle), (1.0 / (1.0 + z)) * slip);
  const double half = 0.5 * angle, square = half * half;
  const double sinc = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0));
  const Vec2 path = rotate(turned({}, -half), (dt * (logarithm / z) * sinc) * slip);
  return {after, path - dt * after};
}

GEM_HD inline SpinDragSolution spin_drag_quadratic(double k, double spin, double dt) {
  const double z = drag_reach(k, spin < 0.0 ? -spin : spin, dt);
  if (!(z > 0.0)) return {spin, 0.0};
  return shared_out(drag_shares(z, strict::log1p(z), dt), spin);
}

/// Linear law with rate = 1/tau [1/s]; `decay` is e^(-rate dt), equal for all floes and time steps.
GEM_HD inline DragSolution drag_linear(double rate, Vec2 slip, double decay, double dt) {
  return {decay * slip, ((1.0 - decay) / rate - decay * dt) * slip};
}

GEM_HD inline SpinDragSolution spin_drag_linear(double rate, double spin, double decay, double dt) {
  return {decay * spin, ((1.0 - decay) / rate - decay * dt) * spin};
}

}  // namespace gem
