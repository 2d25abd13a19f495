// Mass reduction factor and effective mass of a collision in the plane.
//
// R = l^2 + m^2 + eta^2 / r^2,   M_e = M / R        (Popov 1967; Daley 1999)
//
//   l, m   direction cosines of the contact normal; l^2 + m^2 = 1                        [-]
//   eta    moment arm of the normal about the centroid, eta = arm x normal               [m]
//   r^2    squared radius of gyration, inertia / mass                                    [m2]
//
// Valid for a rigid body and a contact of short duration. A fixed body has inverse masses 0 and no finite R. Neglected:
// added mass of floes, which the paper sets to 0. That of the platform follows a hit: added_mass.h.
#pragma once

#include "gem/base/vec2.h"

namespace gem {

/// Inverse mass and inertia of a body in a collision.
struct CollisionMass {
  double inverse_mass = 0.0;     // [1/kg]
  double inverse_inertia = 0.0;  // [1/(kg m2)]
};

/// R of one body, in the paper's formulation. `radius_of_gyration2` is r^2 [m2]. No run calls it: runs use R / M, see
/// inverse_effective_mass(), which is also valid for fixed bodies. The closed-form tests compare both.
GEM_HD constexpr double mass_reduction_factor(Vec2 normal, Vec2 arm, double radius_of_gyration2) {
  const double eta = cross(arm, normal);
  return dot(normal, normal) + eta * eta / radius_of_gyration2;
}

/// R / M of one body along `direction` at `arm`: its term of the inverse effective mass [1/kg].
GEM_HD constexpr double inverse_effective_mass(CollisionMass body, Vec2 arm, Vec2 direction) {
  const double eta = cross(arm, direction);
  return body.inverse_mass + body.inverse_inertia * eta * eta;
}

/// Change of the relative velocity of two bodies at a point per impulse at that point [1/kg].
struct ContactCompliance {
  double nn = 0.0;  // normal to normal; 1/nn is the effective mass of the pair
  double tt = 0.0;  // tangential to tangential
  double nt = 0.0;  // cross term
};

/// Compliance of a pair; the tangent is the normal turned left.
GEM_HD constexpr ContactCompliance contact_compliance(CollisionMass a, Vec2 arm_a, CollisionMass b, Vec2 arm_b,
                                                      Vec2 normal) {
  const Vec2 tangent = turned_left(normal);
  const double eta_a = cross(arm_a, normal), eta_b = cross(arm_b, normal);
  const double xi_a = cross(arm_a, tangent), xi_b = cross(arm_b, tangent);
  const double mass = a.inverse_mass + b.inverse_mass;
  return {mass + a.inverse_inertia * eta_a * eta_a + b.inverse_inertia * eta_b * eta_b,
          mass + a.inverse_inertia * xi_a * xi_a + b.inverse_inertia * xi_b * xi_b,
          a.inverse_inertia * eta_a * xi_a + b.inverse_inertia * eta_b * xi_b};
}

}  // namespace gem
