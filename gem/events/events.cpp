// Constants that are derived from the definitions once per run.
#include "gem/events/events.h"

#include <cmath>

namespace gem {

Events make_events(const EventDefinitions& definitions, const PlatformInEvents* platform, double dt) {
  Events e;
  static_cast<EventDefinitions&>(e) = definitions;
  e.dt = dt;
  e.linear_decay = std::exp(-dt / definitions.water.linear_time_s);
  e.platform_present = platform != nullptr;
  if (!platform) return e;
  const MooringDef& mooring = definitions.mooring;
  e.anchor = platform->anchor;
  e.mooring_damped = mooring.stiffness_N_per_m > 0.0 && mooring.damping_ratio > 0.0;
  e.half_mooring = mooring_flow(mooring.stiffness_N_per_m, platform->mass, mooring.damping_ratio, 0.5 * dt);
  const PlatformDragDef& drag = definitions.platform_drag;
  if (!drag.present) return e;
  e.platform_drag_rate = platform_drag_rate(definitions.water.density_kg_per_m3, drag.coefficient, platform->diameter,
                                            drag.draft_m, platform->mass);
  if (drag.water == DampingWater::current) e.platform_water = definitions.current.velocity_m_per_s;
  return e;
}

}  // namespace gem
