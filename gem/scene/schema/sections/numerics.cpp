// Keys of [numerics].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_numerics(SceneTable& t) {
  t.number("numerics.time_step_s", "s", {1e-6, 100.0}, "time step dt", GEM_FIELD(numerics.time_step_s));
  t.number("numerics.residual_tolerance", "", {0.0, 1.0, true},
           "coupled: iterations end when the residual is below this share of the current speed; with gradient 1e-05 if "
           "it is not given",
           GEM_FIELD(numerics.residual_tolerance));
  t.integer(
      "numerics.iterations_maximum", {1.0, 1e5},
      "coupled: largest number of iterations in one time step; with splitting those with the matrix; with gradient 32 "
      "if it is not given",
      GEM_FIELD(numerics.iterations_maximum));
  t.choice(
      "numerics.iteration", {"gradient", "splitting"},
      "coupled: splitting: each island by itself, first by cheap iterations, then, where they do not end soon, by "
      "iterations with a factored matrix, few to converge; gradient: cheap iterations of all islands together, many to "
      "converge",
      GEM_FIELD(numerics.iteration));
  t.number("numerics.list_margin_m", "m", {0.0, 1e3}, "pairs closer than this are in the pair list",
           GEM_FIELD(numerics.list_margin_m));
  t.number("numerics.contact_reach", "steps", {0.0, 100.0},
           "coupled: faces that the current could close within this many time steps count as contacts; their floes "
           "move with "
           "their velocity after the events, not along the exact path of the drag",
           GEM_FIELD(numerics.contact_reach));
  t.number("numerics.repair_share", "", {0.0, 1.0}, "coupled: share of an overlap removed in one time step",
           GEM_FIELD(numerics.repair_share));
  t.number("numerics.repair_speed_m_per_s", "m/s", {0.0, 1e3}, "coupled: largest speed at which an overlap is removed",
           GEM_FIELD(numerics.repair_speed_m_per_s));
  t.counts_with = {"contact.solver", "compliant"};
  t.integer("numerics.substeps", {0.0, 1e5},
            "compliant: substeps of a time step; 0: as many as stiffness and mass of the floes ask for",
            GEM_FIELD(numerics.substeps));
  t.counts_with = {};
}

}  // namespace gem::sections
