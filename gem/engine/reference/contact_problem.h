// Impulses of all contact points that have to be resolved together:
//
//   u_n >= target,  0 <= P_n <= cap        u_n > target only where P_n = 0, u_n < target only where P_n = cap
//   |P_t| <= mu P_n,  P_t against the remaining slip                  friction law one_step (Coulomb)
//   P_t = -mu P_n sign(u_t before)                                    friction law fixed_direction
// In the time step after a rise of the load both laws go on as friction_memory.h says.
//
//   u_n, u_t  velocity of B relative to A along the normal and along the normal turned left, after the impulses [m/s]
//   P_n, P_t  impulse on B; the opposite acts on A                                                              [N s]
//
// The position repair is the same problem: shifts for velocities, no friction, no cap; but it may have no answer.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/events/friction_memory.h"
#include "gem/events/impact.h"
#include "gem/scene/scene_def.h"

namespace gem::reference {

/// A contact point. For the position repair: shifts [m] for velocities, impulses in kg m, and no friction.
struct ProblemPoint {
  std::int32_t a = 0, b = 0;
  Vec2 normal;                                           // from A to B
  Vec2 arm_a, arm_b;                                     // from the centroids [m]
  double target = 0.0;                                   // smallest u_n [m/s]
  double cap = std::numeric_limits<double>::infinity();  // largest P_n [N s]
  double friction = 0.0;                                 // mu [-]
  SpareFriction spare;                                   // friction beyond mu P_n [N s]
  ContactImpulse last;                                   // impulse of the last time step [N s]
  double rise = 0.0;                                     // of its normal impulse [N s]
};

/// A body in the problem.
struct ProblemBody {
  CollisionMass mass;
  Vec2 velocity;      // before the impulses [m/s]
  double spin = 0.0;  // [rad/s]
};

struct ContactSolution {
  std::vector<ContactImpulse> impulse;  // of each point
  double residual = 0.0;                // largest remaining normal or tangential velocity change [m/s]
  int steps = 0;                        // of the group with the most steps
};

/// What solve_contacts() does if not every target can be met.
enum class Infeasible {
  throws,     ///< Error(numerical_stop)
  regularise  ///< all points fall short of their targets
};

/// Solves the problem. Points are independent of each other where no moving body joins them.
ContactSolution solve_contacts(const std::vector<ProblemPoint>& points, const std::vector<ProblemBody>& bodies,
                               FrictionLaw law, Infeasible infeasible = Infeasible::throws);

}  // namespace gem::reference
