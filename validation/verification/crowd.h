// A crowd of floes between walls and a moored platform: the scene of the invariance tests, which need no closed form.
#pragma once

#include <cstdint>

#include "validation/verification/scenes.h"

namespace gem::verification {

/// What stands around the floes.
enum class Surroundings { open_water, walls_and_platform };

/// 35 spinning floes of 4 to 7 sides that drift together, with drag and friction. Independent runs have the paper's
/// contacts (chord middle, elastic stress), coupled runs have faces.
SceneDef crowd(const Setting& setting, Surroundings surroundings = Surroundings::walls_and_platform);

/// The same scene resolved to rounding and without position repair.
SceneDef settled(SceneDef scene);

/// Bodies of the crowd after it has pressed together for 80 s: many pairs touch. Nothing of that run is kept but the
/// bodies, so runs started from them begin alike.
Bodies pressed(const SceneDef& scene, const Setting& setting);

/// Starts an engine of the setting on given bodies.
Simulation start_on(const SceneDef& scene, Bodies bodies, const Setting& setting);

/// Advances and returns how many touching points were met; fails if there were none.
std::int64_t advance_in_contact(Simulation& run, std::int64_t steps);

/// Bodies among the first `count` (0: all) whose state differs in any bit.
int different_bits(const Bodies& a, const Bodies& b, std::size_t count = 0);

/// Largest distance between the same corners of two states, in metres: position and angle in one number.
double farthest_apart(const Bodies& a, const Bodies& b);

}  // namespace gem::verification
