// Checks of where the floes come from.
#pragma once

#include <vector>

#include "gem/scene/check_scene.h"

namespace gem {

/// Whether the floes are generated: of own shapes or copies.
bool is_made(const FloesDef& floes);

/// Keys of a floe file without one, and listed floes that nothing uses.
void check_source(const SceneDef& s, std::vector<SceneProblem>& out);

/// floes.concentration where no field is made, or too low.
void check_concentration(const SceneDef& s, std::vector<SceneProblem>& out);

}  // namespace gem
