// How well a coupled time step obeys the laws of contact, contact by contact: complementarity, friction cone,
// dissipation.
//
// The impulses P are those stored by the engine for its warm start; the velocities u are those after the events. For
// each point, with compliance K and u_n the normal velocity above its target, in m/s:
//   pull              K_nn max(0, -P_n)                      a contact never pulls
//   closing           max(0, -u_n)                           no point still closes
//   complementarity   |min(K_nn P_n, u_n)|                   either no impulse or no separation
//   cone              K_tt max(0, |P_t| - mu P_n)            Coulomb's bound, with the spare friction of the last step
//   slip              |K_tt P_t - clamp(K_tt P_t - u_t)|     sticks, or slips against friction at its bound
// For the time step: the energy that its events added, which must not be positive [J].
#pragma once

#include "gem/engine/engine.h"

namespace gem::hard {

/// Largest residuals of one time step, or of several merged.
struct ContactResiduals {
  std::int64_t points = 0;
  std::int64_t without_point = 0;  // impulses stored for points that the bodies do not have
  double pull = 0.0;
  double closing = 0.0;
  double complementarity = 0.0;
  double cone = 0.0;
  double slip = 0.0;

  void merge(const ContactResiduals& other);
  double worst() const;  // [m/s]
};

/// Residuals of the time step from `before` to `after`, both saved by the same engine, in a coupled scene without
/// mooring. (With a mooring the platform's velocity at the events is not saved.)
ContactResiduals contact_residuals(const SceneDef& scene, const EngineState& before, const EngineState& after);

}  // namespace gem::hard
