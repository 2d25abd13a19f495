// The case that a run file holds.
#pragma once

#include <string>

#include "gem/record/run_file/run_file.h"

namespace gem {

/// The resolved text of the case. Throws Error(file_system) if its hash is not the one that the file states, or if it
/// holds control characters.
std::string stored_case(const RunFile& file);

/// The same as a scene. Nothing that it names is opened: the floes of floes.path are in the run file too.
SceneDef stored_scene(const RunFile& file);

}  // namespace gem
