// Drag coefficients of the floes: what the current does to the speed and the spin of each outline.
//
// Quadratic law, k of dw/dt = -k |w| w, w the velocity through the water [1/m]:
//   k   = rho_w (C_f W T / 2 + C_s A) / m,        W = sqrt(A) width, T = h rho_ice / rho_w draft
// and of the spin, k_w of d(omega)/dt = -k_w |omega| omega [-]:
//   k_w = rho_w (C_s S + C_f T E / 2) / I
//   S = integral of r^3 over the outline about its centroid [m5]
//   E = half the sum over the edges of the integral of |s|^3 ds [m4], s along the edge from the foot of the
//       perpendicular from the centroid. Half, because only the half of an edge that moves outward has form drag.
// Linear law: both are 1 / tau [1/s].
#pragma once

#include <vector>

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Integral of r^3 dA about the origin [m5] of a counter-clockwise outline; closed form.
double integral_r3(const std::vector<Vec2>& outline);

/// Half the sum over the edges of the integral of |s|^3 ds [m4].
double edge_integral_s3(const std::vector<Vec2>& outline);

/// Sets drag and spin_drag of body i; 0 unless it is a floe.
void set_floe_drag(Bodies& bodies, std::size_t i, const SceneDef& scene);

/// Sets drag and spin_drag of every floe. The platform and fixed bodies get 0.
void set_drag(Bodies& bodies, const SceneDef& scene);

}  // namespace gem
