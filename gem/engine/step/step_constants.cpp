#include "gem/engine/step/step_constants.h"

#include <algorithm>
#include <cmath>

#include "gem/engine/solver/iteration_control.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_bounds.h"
#include "gem/scene/scene_drive.h"

namespace gem {
namespace {

/// Two corners that point at each other are farther apart than the narrow phase measures along the normals of their
/// faces. So a list of pairs closer than the contact margin would miss contacts, and bits would depend on the list.
/// This many contact margins more are enough where the two angles at the corners are above 30 degrees together.
constexpr double corner_distance = 4.0;

}  // namespace

DpLaw dp_law_of(const SceneDef& scene, const Bodies& bodies) {
  if (!scene.platform.present || scene.platform.fixed) return {};
  return dp_law(scene.dp, dp_inertia(bodies.mass[0], bodies.inertia[0], scene.added_mass), scene.numerics.time_step_s);
}

StepConstants step_constants(const SceneDef& scene, const Bodies& bodies, const MooringView& mooring, const DpLaw* dp) {
  StepConstants c;
  c.dt = scene.numerics.time_step_s;
  const PlatformDef& p = scene.platform;
  const PlatformInEvents platform{p.anchor_m,
                                  p.present ? bodies.mass[0] : 0.0,
                                  platform_drag_width(p),
                                  platform_drag_length(p),
                                  p.present ? bodies.inertia[0] : 0.0,
                                  p.yaw == Yaw::free,
                                  mooring,
                                  dp,
                                  in_transit(scene.transit),
                                  transit_thrust(scene, p.present ? bodies.mass[0] : 0.0)};
  c.events = make_events(scene, p.present && !p.fixed ? &platform : nullptr, c.dt, has_wind(scene));

  c.solver = scene.contact.solver;
  c.manifold = scene.contact.manifold;

  const double fastest = fastest_point(scene);
  c.contact_margin = speed_foreseen(scene) * c.dt;
  c.residual_speed = scene.numerics.residual_tolerance * fastest;
  c.tight_residual = scene.numerics.residual_tolerance < IterationControl::single_precision;
  c.iterations_maximum = scene.numerics.iterations_maximum;
  c.iteration = scene.numerics.iteration;
  const bool rough = scene.ice.friction_ice > 0.0 || scene.ice.friction_structure > 0.0;
  c.point_friction = !rough                                                ? PointFriction::none
                     : scene.contact.friction_law == FrictionLaw::one_step ? PointFriction::coulomb
                                                                           : PointFriction::fixed_direction;
  c.repair_share = scene.numerics.repair_share;
  c.repair_speed = scene.numerics.repair_speed_m_per_s;
  // the contact reach beyond the drift of one time step
  c.repair_reach = std::max((scene.numerics.contact_reach - 1.0) * fastest, c.repair_speed) * c.dt;
  c.drive_speed = drive_speed(scene);
  c.list_margin = std::max(scene.numerics.list_margin_m, corner_distance * c.contact_margin);
  // 400: chosen by hand; bounds the life of a list in slow water, affects only speed
  const double drift_speed = drive_speed(scene) + 1e-3;
  c.list_horizon = std::clamp<std::int64_t>(static_cast<std::int64_t>(c.list_margin / (drift_speed * c.dt)), 1, 400);
  c.retire_x = scene.output.retire_x_m;
  c.pieces = platform_bodies(bodies);
  return c;
}

}  // namespace gem
