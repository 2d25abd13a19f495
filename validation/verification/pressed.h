// Scenes in which the current presses floes against walls.
#pragma once

#include <cstdint>

#include "validation/verification/scenes.h"

namespace gem::verification {

/// The C_d of the closed forms is 2 C_s here.
constexpr double skin = 0.5 * 0.005;

/// Skin coefficient that gives a floe 0.5 m thick the rate k [1/m].
double skin_for(double k);

/// A quiet scene with a current, skin drag and friction of ice, in time steps of `dt`.
SceneDef pressed_scene(Vec2 current, double skin_coefficient, double friction, double dt);

/// A floor 4 km long, rotated about the origin.
FixedDef long_floor(double angle);

/// Force of the fixed bodies on the floes over the next `steps` time steps [N].
Vec2 force_of_fixed(Simulation& run, std::int64_t steps, double dt);

/// Relative shortfall of the drag on a floe held by a wall, k |w| dt: the drag acts before the wall stops the floe.
double drag_shortfall(double k, double slip, double dt);

/// Checks the books of a scene within `reach` metres of the origin. The moments on a held floe cancel, so the ledger's
/// own scale of angular momentum may be close to zero.
void expect_held_books(Simulation& run, double reach);

}  // namespace gem::verification
