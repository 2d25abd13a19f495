// Constants of a run, derived once from the scene.
#pragma once

#include <cstdint>

#include "gem/base/macros.h"
#include "gem/base/vec2.h"
#include "gem/engine/solver/coupled_point.h"
#include "gem/events/events.h"
#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Constants of every stage. Plain values, copied to where the stages run.
struct StepConstants {
  Events events;    // the laws
  double dt = 0.0;  // [s]

  ContactSolver solver = ContactSolver::coupled;
  Manifold manifold = Manifold::chord_ends;
  double contact_margin = 0.0;  // coupled: faces closer than this form a contact [m]
  PointFriction point_friction = PointFriction::coulomb;
  double residual_speed = 0.0;  // coupled: iterations stop at this residual [m/s]
  bool tight_residual = false;  // the residual is below the resolution of single precision
  std::int64_t iterations_maximum = 0;
  Iteration iteration = Iteration::gradient;
  double repair_share = 0.0;      // share of an overlap that is repaired in one time step [-]
  double repair_speed = 0.0;      // largest speed of the repair [m/s]
  double repair_reach = 0.0;      // coupled: largest repair motion of any point of a body in one time step [m]
  double drive_speed = 0.0;       // largest speed of water and air on floes, see scene_drive.h [m/s]
  double list_margin = 0.0;       // [m]
  std::int64_t list_horizon = 1;  // longest life of a list of near pairs [time steps]
  double retire_x = 0.0;          // [m]
  std::int32_t pieces = 1;        // of the platform: bodies 0 to pieces - 1

  /// The residual at which the iterations end [m/s]; NaN: the solver has none.
  double asked_residual() const {
    return solver == ContactSolver::coupled ? residual_speed : std::numeric_limits<double>::quiet_NaN();
  }
  GEM_HD bool is_platform(std::int32_t body) const { return body < pieces; }
  /// The body that takes the impulses of `body` and is in the books: of a piece of the platform, body 0.
  GEM_HD std::int32_t owner_of(std::int32_t body) const { return body < pieces ? 0 : body; }
};

/// The law of dynamic positioning of a scene; without thrusters: none.
DpLaw dp_law_of(const SceneDef& scene, const Bodies& bodies);

/// `mooring` and `dp`: the tables of mooring_tables() and the law of dp_law_of(), which must outlive the constants.
/// Only code that moves the platform needs them.
StepConstants step_constants(const SceneDef& scene, const Bodies& bodies, const MooringView& mooring = {},
                             const DpLaw* dp = nullptr);

}  // namespace gem
