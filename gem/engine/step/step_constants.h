// What stays the same from step to step, worked out once per run from the scene.
#pragma once

#include <cstdint>

#include "gem/base/vec2.h"
#include "gem/engine/solver/coupled_point.h"
#include "gem/events/events.h"
#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Constants of every stage. Plain values: copied to wherever the stages run.
struct StepConstants {
  double dt = 0.0;  // [s]
  Vec2 current;     // [m/s]
  DragLaw drag_law = DragLaw::none;
  double linear_decay = 1.0;  // e^(-dt/tau)

  Vec2 anchor;
  MooringFlow half_mooring;     // over dt / 2
  bool moored_or_free = false;  // the platform exists
  bool mooring_damped = false;
  double stiffness = 0.0;           // [N/m]
  double platform_drag_rate = 0.0;  // [1/m]; 0: none
  Vec2 platform_water;              // [m/s]

  ContactSolver solver = ContactSolver::coupled;
  Manifold manifold = Manifold::chord_ends;
  FrictionLaw friction_law = FrictionLaw::one_step;
  double friction_ice = 0.0;
  double friction_structure = 0.0;
  double elastic_stiffness = 0.0;  // [N/m]
  CrushingIce ice;                 // thickness is set per contact

  double contact_margin = 0.0;  // coupled: faces closer than this are held apart [m]
  PointFriction point_friction = PointFriction::coulomb;
  double residual_speed = 0.0;  // coupled: iterations stop when no point asks for more [m/s]
  bool tight_residual = false;  // below what single precision can tell of it
  std::int64_t iterations_maximum = 0;
  bool crushing_limit = true;  // coupled
  double repair_share = 0.0;   // share of an overlap taken back in one time step [-]
  double repair_speed = 0.0;   // ... at most at this speed [m/s]
  double repair_reach = 0.0;   // coupled: farthest that the repair takes a point of a body in one time step [m]
  double list_margin = 0.0;    // [m]
  double retire_x = 0.0;       // [m]
};

StepConstants step_constants(const SceneDef& scene, const Bodies& bodies);

}  // namespace gem
