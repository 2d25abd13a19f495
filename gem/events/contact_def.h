// Options of the pair events.
#pragma once

namespace gem {

/// How the events of one time step are resolved.
enum class ContactSolver {
  independent,  ///< the paper: each pair event once, from the state at the start of the step
  coupled,      ///< all events of the time step together, iterated to a residual
  compliant     ///< ice that springs and crushes, in substeps
};

/// The solver as contact.solver names it.
constexpr const char* solver_name(ContactSolver solver) {
  switch (solver) {
    case ContactSolver::independent:
      return "independent";
    case ContactSolver::coupled:
      return "coupled";
    case ContactSolver::compliant:
      return "compliant";
  }
  return "unknown";
}

/// Where the impulses of one contact act.
enum class Manifold {
  chord_middle,  ///< one point in the middle of the chord between the crossings of the outlines
  chord_ends     ///< both ends of the facing stretch, so that a resting face can carry a moment
};

enum class FrictionLaw {
  one_step,        ///< Coulomb's law for the velocity after the event: stick or slip
  fixed_direction  ///< the paper: friction against the tangential velocity before the event
};

struct ContactDef {
  ContactSolver solver = ContactSolver::compliant;
  Manifold manifold = Manifold::chord_ends;
  FrictionLaw friction_law = FrictionLaw::one_step;
  bool crushing_limit = true;              ///< coupled: no impulse above that which crushes the smaller body
  double elastic_stiffness_N_per_m = 1e6;  ///< of the static stress in `independent`; 0 switches it off
  // compliant
  double face_stiffness_Pa = 1e8;            ///< stiffness of a face on a face over the thickness of the thinner floe
  double damping_ratio = 0.5;                ///< zeta of a face that moves straight
  double structure_stiffness_N_per_m = 1e9;  ///< of a structure on a wall
};

}  // namespace gem
