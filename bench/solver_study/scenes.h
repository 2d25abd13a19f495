// The scenes of the study: cases by file and name, and states of them.
#pragma once

#include <string>
#include <vector>

#include "gem/engine/engine.h"

namespace gem::bench {

/// A case file, or one run of a sweep: FILE#NAME. Throws gem::Error.
SceneDef scene_named(const std::string& text);

/// State at `time` as the default solver leaves it; `leader` is moved on and must not be past it.
EngineState state_at(Engine& leader, double time_step_s, double time);

}  // namespace gem::bench
