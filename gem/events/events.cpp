// Constants that are derived from the definitions once per run.
#include "gem/events/events.h"

#include <cmath>

#include "gem/base/strict_math.h"

namespace gem {

namespace {

void set_floe_laws(Events& e, bool wind) {
  e.linear_decay = std::exp(-e.dt / e.water.linear_time_s);
  e.drag_is_turned = e.water.turning_rad != 0.0;
  e.turning = turning_of(e.water.turning_rad);
  e.wind_on_floes = wind;
  e.floes_are_pushed = wind || e.coriolis.parameter_per_s != 0.0;
  e.half_coriolis = coriolis_turn(e.coriolis.parameter_per_s, 0.5 * e.dt);
  e.freeboard = 1.0 - e.ice.density_kg_per_m3 / e.water.density_kg_per_m3;
}

/// No law for a platform that cannot turn.
HeadingLaw heading_law(const HeadingDef& def, const PlatformInEvents& platform, double dt) {
  if (!platform.turns || !(platform.inertia > 0.0)) return {};
  return {def.moment_N_m, strict::exp(-def.damping_N_m_s * 0.5 * dt / platform.inertia), 0.5 * dt};
}

/// Laws beyond the linear mooring of surge and sway.
MooringLaws mooring_laws(const MooringDef& def, const PlatformInEvents& platform, const AddedMass& water, double dt) {
  MooringLaws m;
  m.law = def.law;
  m.anchor = platform.anchor;
  m.stiffness = def.stiffness_N_per_m;
  m.yaw_stiffness = def.yaw_stiffness_N_m_per_rad;
  m.step = 0.5 * dt;
  m.flow = mooring_flow(def.stiffness_N_per_m, platform.mass, def.damping_ratio, m.step);
  m.decay = std::exp(-def.damping_N_s_per_m * m.step / platform.mass);
  m.yaw_decay = std::exp(-def.yaw_damping_N_m_s_per_rad * m.step / platform.inertia);
  m.view = platform.mooring;
  m.added_mass = water;
  m.present = water.present || def.law != MooringLaw::linear || def.damping_N_s_per_m > 0.0 ||
              def.yaw_stiffness_N_m_per_rad > 0.0 || def.yaw_damping_N_m_s_per_rad > 0.0;
  return m;
}

/// Of a platform that cannot turn: no drag of the yaw.
AxisDrag axis_drag(const EventDefinitions& definitions, const PlatformInEvents& platform) {
  const PlatformDragDef& def = definitions.platform_drag;
  const double density = definitions.water.density_kg_per_m3;
  AxisDrag drag;
  drag.surge = platform_drag_rate(density, def.surge_coefficient, platform.diameter, def.draft_m, platform.mass);
  drag.sway = platform_drag_rate(density, def.sway_coefficient, platform.length, def.draft_m, platform.mass);
  if (platform.turns && platform.inertia > 0.0)
    drag.yaw = yaw_drag_rate(density, def.yaw_coefficient, platform.length, def.draft_m, platform.inertia);
  return drag;
}

}  // namespace

Events make_events(const EventDefinitions& definitions, const PlatformInEvents* platform, double dt, bool wind) {
  Events e;
  static_cast<EventDefinitions&>(e) = definitions;
  e.dt = dt;
  set_floe_laws(e, wind);
  e.platform_present = platform != nullptr;
  if (!platform) return e;
  const MooringDef& mooring = definitions.mooring;
  e.anchor = platform->anchor;
  e.mooring_damped = mooring.stiffness_N_per_m > 0.0 && mooring.damping_ratio > 0.0;
  e.half_mooring = mooring_flow(mooring.stiffness_N_per_m, platform->mass, mooring.damping_ratio, 0.5 * dt);
  e.heading = heading_law(definitions.heading, *platform, dt);
  e.added_mass =
      added_mass(definitions.added_mass, platform->mass, platform->inertia, platform->turns && platform->inertia > 0.0);
  e.moored = mooring_laws(mooring, *platform, e.added_mass, dt);
  if (platform->dp && platform->dp->thrusters > 0) e.dp = platform->dp;
  if (platform->towed) e.tow_rate = tow_rate(dt);
  e.thrust = platform->thrust;
  if (wind) e.platform_wind_rate = platform_wind_rate(definitions.wind, platform->mass);
  const PlatformDragDef& drag = definitions.platform_drag;
  if (!drag.present) return e;
  if (drag.law == PlatformDragLaw::by_axis)
    e.axis_drag = axis_drag(definitions, *platform);
  else
    e.platform_drag_rate = platform_drag_rate(definitions.water.density_kg_per_m3, drag.coefficient, platform->diameter,
                                              drag.draft_m, platform->mass);
  return e;
}

}  // namespace gem
