// A crowd of floes between walls and a moored platform: the scene of the invariance tests, which need no closed form.
#pragma once

#include <cstdint>

#include "validation/verification/scenes.h"

namespace gem::verification {

/// What surrounds the floes.
enum class Surroundings { open_water, walls_and_platform };

/// 35 spinning floes with 4 to 7 sides that drift together, with drag and friction. Independent runs have the paper's
/// contacts (chord middle, elastic stress); coupled runs have faces.
SceneDef crowd(const Setting& setting, Surroundings surroundings = Surroundings::walls_and_platform);

/// The scene solved to rounding and without position repair.
SceneDef settled(SceneDef scene);

/// Bodies of the crowd after 80 s of pressing together, with many contacts. Only the bodies are kept, so runs that
/// start from them have equal starts.
Bodies pressed(const SceneDef& scene, const Setting& setting);

/// Starts an engine with the setting from given bodies.
Simulation start_on(const SceneDef& scene, Bodies bodies, const Setting& setting);

/// Advances and returns the number of contact points; fails if there were none.
std::int64_t advance_in_contact(Simulation& run, std::int64_t steps);

/// Number of bodies among the first `count` (0: all) whose state differs in any bit.
int different_bits(const Bodies& a, const Bodies& b, std::size_t count = 0);

/// Largest distance between the same corners in two states [m]: position and angle in one number.
double farthest_apart(const Bodies& a, const Bodies& b);

/// A run of 40 time steps has the bits of one that is saved after 15 and goes on in another engine.
void expect_restart_changes_nothing(const SceneDef& scene, const Setting& setting);

}  // namespace gem::verification
