// A field at nine tenths of cover: denser than floes can be placed at random.
#pragma once

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem::hard {

/// `columns` x `rows` quadrilaterals, all different, cut from a distorted net of 10 m and shrunk to 0.9 of their area,
/// in a closed channel; the current of 0.25 m/s presses them to the wall at its end.
SceneDef tight_scene(int columns, int rows);

/// Share of the closed channel that ice covers at the start.
double cover_of(const SceneDef& scene, const Bodies& field);

}  // namespace gem::hard
