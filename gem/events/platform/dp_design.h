// Dynamic positioning as a case gives it, and the constants of its law, which are made once per run.
#pragma once

#include <array>
#include <vector>

#include "gem/events/platform/added_mass.h"
#include "gem/events/platform/dp.h"

namespace gem {

enum class ThrusterKind { azimuth, fixed, tunnel };

/// One [[dp.thruster]].
struct ThrusterDef {
  ThrusterKind kind = ThrusterKind::azimuth;
  Vec2 position_m;             ///< from the platform's centre at yaw 0
  double direction_rad = 0.0;  ///< of the thrust of a fixed one, from the ship's x axis
  double maximum_N = 5e5;
  double reverse_share = 1.0;  ///< of a fixed one: largest thrust backwards over `maximum_N`
  double rate_N_per_s = 0.0;   ///< largest change; 0: at once
};

/// Gains of surge, sway and yaw: proportional, derivative, integral.
using GainRow = std::array<double, 3>;

struct DpDef {
  std::vector<ThrusterDef> thruster;  ///< none: no dynamic positioning
  Vec2 position_m;                    ///< set point
  double yaw_rad = 0.0;               ///< set point
  bool follows_drift = false;         ///< yaw_rad counts from the direction that the water flows to
  double surge_period_s = 80.0, sway_period_s = 80.0, yaw_period_s = 80.0;
  double damping_ratio = 0.8;
  double integral_time_s = 0.0;  ///< K_p / K_i; 0: no integral
  std::vector<GainRow> gains;    ///< in place of the four above
  double filter_time_s = 0.0;    ///< 0: no filter
};

/// What the thrusters move: mass in surge and in sway [kg], moment of inertia [kg m2].
using DpInertia = std::array<double, 3>;

/// A platform of `mass` [kg] and `inertia` [kg m2] with its added mass.
inline DpInertia dp_inertia(double mass, double inertia, const AddedMassDef& added) {
  return {mass + added.surge_kg, mass + added.sway_kg, inertia + added.yaw_kg_m2};
}

/// Gains of surge, sway and yaw. Host only.
std::array<DpGain, 3> dp_gains(const DpDef& def, const DpInertia& inertia);

/// The constants of the law; no thrusters: none. Host only, once per run.
DpLaw dp_law(const DpDef& def, const DpInertia& inertia, double dt);

}  // namespace gem
