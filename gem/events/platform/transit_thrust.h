// Thrust of a ship in transit that runs free: what its propellers give beyond the resistance of open water.
//
//   T = T_b (1 - x / 3 - 2 x^2 / 3),   x = v / v_o       for x > 0;       T = T_b for x <= 0
//
//   T    net thrust along the course: what is left for ice and wind [N]
//   v    speed through the water along the course [m/s]
//   T_b  bollard thrust, the thrust at v = 0 [N]
//   v_o  speed in open water, at which nothing is left [m/s]
//
// A ship of mass M alone obeys dx/ds = (1 - x) (1 + 2 x / 3) in the time s = t T_b / (M v_o). Then
// y = (1 - x) / (1 + 2 x / 3) falls as e^(-5 s / 3), so the speed after a time is exact. Half of a time step acts
// before all other events of the ship, half after them; a steady force beside the thrust is an error of order dt^2.
//
// Sources: Riska, Wilhelmson, Englund, Leiviska (Performance of merchant vessels in ice in the Baltic, Winter
// Navigation Research Board, report 52, 1997); Juva, Riska (On the power requirement in the Finnish-Swedish ice class
// rules, report 53, 2002). Range: a ship that goes ahead, 0 <= v <= v_o, at one setting of its engine. Astern the
// bollard thrust stays, which is not from the sources. Neglected: the time in which an engine changes its thrust, ice
// in the propellers, the thrust that a ship loses in shallow water or while it turns.
#pragma once

#include "gem/base/strict_math.h"
#include "gem/base/vec2.h"
#include "gem/events/platform/transit.h"

namespace gem {

/// The thrust of one ship.
struct ThrustLaw {
  Vec2 course;                    // along which it acts, of length 1
  double open_water_speed = 0.0;  // [m/s]; 0: none
  double step = 0.0;              // half a time step as s [-]
  double decay = 1.0;             // of y in it [-]

  GEM_HD bool present() const { return open_water_speed > 0.0; }
};

constexpr double thrust_decay_rate = 5.0 / 3.0;  // of y over s

/// No law for a ship that is towed. `mass` of the ship [kg], `dt` time step [s].
inline ThrustLaw thrust_law(const TransitDef& def, Vec2 course, double mass, double dt) {
  if (!runs_free(def)) return {};
  const double step = 0.5 * dt * def.bollard_thrust_N / (mass * def.open_water_speed_m_per_s);
  return {course, def.open_water_speed_m_per_s, step, strict::exp(-thrust_decay_rate * step)};
}

/// Net thrust at the speed through the water [N].
GEM_HD inline double net_thrust(double bollard_thrust, double open_water_speed, double speed) {
  const double x = speed > 0.0 ? speed / open_water_speed : 0.0;
  return bollard_thrust * (1.0 - x) * (1.0 + 2.0 / 3.0 * x);
}

/// Speed through the water after half a time step [m/s].
GEM_HD inline double speed_under_thrust(const ThrustLaw& law, double speed) {
  double x = speed / law.open_water_speed, decay = law.decay;
  if (x < 0.0) {
    x += law.step;
    if (x <= 0.0) return x * law.open_water_speed;
    decay = strict::exp(-thrust_decay_rate * x);  // the rest of the time, from x = 0 on
    x = 0.0;
  }
  const double y = decay * (1.0 - x) / (1.0 + 2.0 / 3.0 * x);
  return law.open_water_speed * (1.0 - y) / (1.0 + 2.0 / 3.0 * y);
}

}  // namespace gem
