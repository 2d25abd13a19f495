// Reads a scene from a document: every key is looked up in the option table and all problems are collected.
#pragma once

#include <optional>

#include "gem/scene/problems.h"
#include "gem/scene/scene_def.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// What a value of the option looks like, for messages: "a number in kg".
std::string expected_text(const OptionInfo& info);

/// The value of one option if it has the right type and lies in its range; otherwise adds a problem. `key` is the full
/// name used in messages.
std::optional<OptionValue> read_value(const OptionInfo& info, const std::string& key, const TomlNode& node,
                                      Problems& problems);

/// Reads all options and lists of the document. What it leaves out keeps its default.
SceneDef scene_from_tree(const TomlNode& document, Problems& problems);

/// Reads the scene and applies check_scene. Throws Error(scene_rejected) with every problem.
SceneDef checked_scene(const TomlNode& document);

/// Every name that a case file may contain, for suggestions.
std::vector<std::string> known_keys();

}  // namespace gem
