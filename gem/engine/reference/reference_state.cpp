#include "gem/engine/reference/reference_state.h"

#include <algorithm>

#include "gem/events/platform/platform_drag.h"
#include "gem/field/platform_pieces.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_bounds.h"
#include "gem/scene/scene_drive.h"

namespace gem::reference {
namespace {

/// Largest speed of any point in the initial state or in current and wind [m/s].
double fastest_of(const SceneDef& scene) {
  double fastest = std::max({1e-3, drive_speed(scene), platform_speed_bound(scene)});
  for (const FloeDef& floe : scene.floe) fastest = std::max(fastest, length(floe.velocity_m_per_s) + rim_speed(floe));
  return fastest;
}

}  // namespace

Rules rules_of(const SceneDef& scene, const Bodies& bodies) {
  Rules rules;
  rules.scene = scene;
  if (platform_bodies(bodies) > 1) rules.piece_corner = corners_of_pieces(bodies);
  rules.dt = scene.numerics.time_step_s;
  rules.drives = drive_schedule(scene);
  const double reach = scene.numerics.contact_reach, fastest = fastest_of(scene);
  if (rules.coupled()) rules.asked_residual = scene.numerics.residual_tolerance * fastest;
  if (rules.coupled() && scene.contact.manifold == Manifold::chord_ends)
    rules.contact_margin = reach * fastest * rules.dt;
  rules.repair_reach = std::max((reach - 1.0) * fastest, scene.numerics.repair_speed_m_per_s) * rules.dt;
  rules.mooring = mooring_tables(scene.mooring.law, scene.mooring_design);
  const double mass = scene.platform.present ? bodies.mass[0] : 0.0;
  const double width = platform_drag_width(scene.platform), hull = platform_drag_length(scene.platform);
  const double inertia = scene.platform.present ? bodies.inertia[0] : 0.0;
  const PlatformInEvents platform{scene.platform.anchor_m, mass, width, hull, inertia, scene.platform.yaw == Yaw::free,
                                  rules.mooring.view()};
  rules.platform_moves = scene.platform.present && !scene.platform.fixed;
  if (rules.platform_moves) rules.dp = dp_law(scene.dp, dp_inertia(mass, inertia, scene.added_mass), rules.dt);
  if (rules.platform_moves && in_transit(scene.transit)) rules.tow_rate = tow_rate(rules.dt);
  if (rules.platform_moves) rules.thrust = transit_thrust(scene, mass);
  rules.events = make_events(scene, rules.platform_moves ? &platform : nullptr, rules.dt, has_wind(scene));
  if (!rules.platform_moves) return rules;
  rules.stiffness = scene.mooring.stiffness_N_per_m;
  rules.half_mooring = mooring_flow(rules.stiffness, mass, scene.mooring.damping_ratio, 0.5 * rules.dt);
  if (has_wind(scene)) rules.platform_wind_rate = platform_wind_rate(scene.wind, mass);
  const PlatformDragDef& drag = scene.platform_drag;
  if (!drag.present) return rules;
  const double density = scene.water.density_kg_per_m3;
  if (drag.law == PlatformDragLaw::round) {
    rules.platform_drag_rate = platform_drag_rate(density, drag.coefficient, width, drag.draft_m, mass);
    return rules;
  }
  rules.axis_drag = {platform_drag_rate(density, drag.surge_coefficient, width, drag.draft_m, mass),
                     platform_drag_rate(density, drag.sway_coefficient, hull, drag.draft_m, mass), 0.0};
  if (bodies.inverse_inertia[0] > 0.0)
    rules.axis_drag.yaw = yaw_drag_rate(density, drag.yaw_coefficient, hull, drag.draft_m, inertia);
  return rules;
}

void State::begin_step(const Rules& rules) {
  drive = rules.drives.at(steps);
  const std::size_t count = bodies.count();
  path_correction.assign(count, {});
  angle_correction.assign(count, 0.0);
  struck.assign(count, 0);
  repair_shift.assign(count, {});
  repair_turn.assign(count, 0.0);
  platform_start = bodies.position[0];
  mooring_impulse = drag_impulse = {};
}

void State::carry_pieces() {
  for (std::size_t i = 1; i < bodies.count() && bodies.kind[i] == BodyKind::platform; ++i) {
    bodies.position[i] = bodies.position[0];
    bodies.rotation[i] = bodies.rotation[0];
    bodies.velocity[i] = bodies.velocity[0];
    bodies.spin[i] = bodies.spin[0];
  }
}

}  // namespace gem::reference
