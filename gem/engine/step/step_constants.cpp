#include "gem/engine/step/step_constants.h"

#include <algorithm>
#include <cmath>

#include "gem/engine/solver/iteration_control.h"
#include "gem/scene/scene_bounds.h"

namespace gem {

namespace {

/// Largest speed of any point that the scene starts with or drives towards [m/s]: the measure of residual and contact
/// margin.
double fastest_of(const SceneDef& scene) {
  constexpr double slowest_of_interest = 1e-3;
  double fastest = std::max(slowest_of_interest, length(scene.current.velocity_m_per_s));
  for (const FloeDef& floe : scene.floe) fastest = std::max(fastest, length(floe.velocity_m_per_s) + rim_speed(floe));
  return std::max(fastest, platform_speed_bound(scene));
}

}  // namespace

StepConstants step_constants(const SceneDef& scene, const Bodies& bodies) {
  StepConstants c;
  c.dt = scene.numerics.time_step_s;
  c.current = scene.current.velocity_m_per_s;
  c.drag_law = scene.water.drag_law;
  c.linear_decay = std::exp(-c.dt / scene.water.linear_time_s);

  c.moored_or_free = scene.platform.present;
  c.anchor = scene.platform.anchor_m;
  if (c.moored_or_free) {
    const double mass = bodies.mass[0];
    c.stiffness = scene.mooring.stiffness_N_per_m;
    c.mooring_damped = c.stiffness > 0.0 && scene.mooring.damping_ratio > 0.0;
    c.half_mooring = mooring_flow(c.stiffness, mass, scene.mooring.damping_ratio, 0.5 * c.dt);
    if (scene.platform_drag.present) {
      c.platform_drag_rate = platform_drag_rate(scene.water.density_kg_per_m3, scene.platform_drag.coefficient,
                                                scene.platform.diameter_m, scene.platform_drag.draft_m, mass);
      if (scene.platform_drag.water == DampingWater::current) c.platform_water = c.current;
    }
  }

  c.solver = scene.contact.solver;
  c.manifold = scene.contact.manifold;
  c.friction_law = scene.contact.friction_law;
  c.friction_ice = scene.ice.friction_ice;
  c.friction_structure = scene.ice.friction_structure;
  c.crushing_limit = scene.contact.crushing_limit;
  c.elastic_stiffness = scene.contact.elastic_stiffness_N_per_m;
  c.ice = {scene.ice.crushing_pressure_Pa, scene.ice.pressure_area_exponent, 0.0};

  const bool coupled = c.solver == ContactSolver::coupled;
  const double fastest = fastest_of(scene);
  if (coupled && c.manifold == Manifold::chord_ends) c.contact_margin = scene.numerics.contact_reach * fastest * c.dt;
  c.residual_speed = scene.numerics.residual_tolerance * fastest;
  c.tight_residual = scene.numerics.residual_tolerance < IterationControl::single_precision;
  c.iterations_maximum = scene.numerics.iterations_maximum;
  const bool rough = c.friction_ice > 0.0 || c.friction_structure > 0.0;
  c.point_friction = !rough                                    ? PointFriction::none
                     : c.friction_law == FrictionLaw::one_step ? PointFriction::coulomb
                                                               : PointFriction::fixed_direction;
  c.repair_share = scene.numerics.repair_share;
  c.repair_speed = scene.numerics.repair_speed_m_per_s;
  // what a contact reaches beyond one time step of drift
  c.repair_reach = std::max((scene.numerics.contact_reach - 1.0) * fastest, c.repair_speed) * c.dt;
  c.list_margin = scene.numerics.list_margin_m;
  c.retire_x = scene.output.retire_x_m;
  return c;
}

}  // namespace gem
