// A field of cover 0.9, denser than random placement can reach.
#pragma once

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem::hard {

/// `columns` x `rows` quadrilaterals, all different, cut from a distorted net of 10 m and shrunk to 0.9 of their area,
/// in a closed channel. A current of 0.25 m/s presses them against the wall at its end.
SceneDef tight_scene(int columns, int rows);

/// Share of the closed channel that is covered by ice at the start.
double cover_of(const SceneDef& scene, const Bodies& field);

}  // namespace gem::hard
