// How many substeps a time step of a scene has. The number is fixed for a run: nothing distant changes it.
//
//   h = kappa min sqrt(m / (12 k)) over the floes, without the lightest 1 % of the area
//
//   m  mass of a floe [kg]     k  stiffness of one of its corners [N/m]
// A corner's compliance is up to 12 / m with a rigid wall and three corners in contact. Where a floe has more, or is
// lighter, its corners are softened (stable_law()); the verdict says how much load went through those with less than
// half of their stiffness. Measured: at most 2 % in a crowd and in jams.
#pragma once

#include <cstdint>

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Substeps of one time step: numerics.substeps if it is given, else by the rule; at least 1.
std::int64_t substep_count(const SceneDef& scene, const Bodies& bodies);

}  // namespace gem
