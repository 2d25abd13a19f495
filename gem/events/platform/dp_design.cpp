// Gains and thrusters of dynamic positioning from the definitions of a case.
#include "gem/events/platform/dp_design.h"

#include <algorithm>
#include <numbers>

namespace gem {
namespace {

DpGain gain_of(double inertia, double period, const DpDef& def) {
  const double omega = 2.0 * std::numbers::pi / period, proportional = inertia * omega * omega;
  return {proportional, 2.0 * def.damping_ratio * inertia * omega,
          def.integral_time_s > 0.0 ? proportional / def.integral_time_s : 0.0};
}

DpThruster thruster_of(const ThrusterDef& def, double dt) {
  constexpr double at_once = 1e300;
  DpThruster t;
  t.position = def.position_m;
  t.azimuth = def.kind == ThrusterKind::azimuth ? 1 : 0;
  const Rotation q = strict::rotation_of_angle(def.direction_rad);
  t.axis = def.kind == ThrusterKind::fixed ? Vec2{q.cosine, q.sine} : Vec2{0.0, 1.0};
  t.maximum = def.maximum_N;
  t.reverse = def.kind == ThrusterKind::fixed ? def.reverse_share * def.maximum_N : def.maximum_N;
  t.step = def.rate_N_per_s > 0.0 ? def.rate_N_per_s * dt : at_once;
  return t;
}

}  // namespace

std::array<DpGain, 3> dp_gains(const DpDef& def, const DpInertia& inertia) {
  if (def.gains.size() == 3) {
    std::array<DpGain, 3> gains;
    for (std::size_t k = 0; k < 3; ++k) gains[k] = {def.gains[k][0], def.gains[k][1], def.gains[k][2]};
    return gains;
  }
  return {gain_of(inertia[0], def.surge_period_s, def), gain_of(inertia[1], def.sway_period_s, def),
          gain_of(inertia[2], def.yaw_period_s, def)};
}

DpLaw dp_law(const DpDef& def, const DpInertia& inertia, double dt) {
  constexpr double rounding = 1e-9;  // of the allocation, over the thrust of all thrusters
  DpLaw law;
  law.thrusters = static_cast<std::int32_t>(std::min<std::size_t>(def.thruster.size(), thrusters_maximum));
  if (law.thrusters == 0) return law;
  law.place = def.position_m;
  law.heading = strict::rotation_of_angle(def.yaw_rad);
  law.follows = def.follows_drift;
  const std::array<DpGain, 3> gains = dp_gains(def, inertia);
  std::copy(gains.begin(), gains.end(), law.gain);
  law.keep = def.filter_time_s > 0.0 ? strict::exp(-dt / def.filter_time_s) : 0.0;
  law.dt = dt;
  double arm = 0.0;
  for (std::int32_t i = 0; i < law.thrusters; ++i) {
    law.thruster[i] = thruster_of(def.thruster[static_cast<std::size_t>(i)], dt);
    arm = std::max(arm, length(law.thruster[i].position));
    law.tolerance += rounding * law.thruster[i].maximum;
  }
  law.arm = arm > 0.0 ? arm : 1.0;
  return law;
}

}  // namespace gem
