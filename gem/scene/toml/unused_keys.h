// Keys that a document states although a choice of another key leaves them without effect.
#pragma once

#include "gem/scene/problems.h"
#include "gem/scene/scene_def.h"
#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// Adds one problem for all stated keys that need the same choice, at the place of the first. A key that states its
/// default is refused too: its reader would believe that it counts.
void check_unused_keys(const TomlNode& document, const SceneDef& scene, Problems& problems);

}  // namespace gem
