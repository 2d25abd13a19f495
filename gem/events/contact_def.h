// How the pair events of one time step are resolved: what a case may choose.
#pragma once

namespace gem {

/// How the events of one time step are resolved.
enum class ContactSolver {
  independent,  ///< the paper: every pair event once, from the same start-of-step state
  coupled       ///< all events of the time step together, to a stated residual
};

/// Where the impulses of one contact act.
enum class Manifold {
  chord_middle,  ///< one point, the middle of the chord that joins the crossings of the outlines
  chord_ends     ///< both ends of the touching stretch: a resting face can carry a moment
};

enum class FrictionLaw {
  one_step,        ///< stick or slip such that the velocity after the event obeys Coulomb's law
  fixed_direction  ///< the paper: friction against the tangential motion before the event
};

struct ContactDef {
  ContactSolver solver = ContactSolver::coupled;
  Manifold manifold = Manifold::chord_ends;
  FrictionLaw friction_law = FrictionLaw::one_step;
  bool crushing_limit = true;              ///< coupled: no event carries more than what crushes the smaller body
  double elastic_stiffness_N_per_m = 1e6;  ///< of the static event in `independent`; 0 leaves it out
};

}  // namespace gem
