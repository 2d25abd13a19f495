// Scenes in TOML: read, override, check, write back.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

/// Reads and checks a case file with its includes; `overrides` are "key.path=value" in TOML syntax, applied last.
/// Paths in the case are made relative to the case file. Throws Error(scene_rejected) listing every problem with
/// file:line:column, Error(file_system) if a file cannot be read.
SceneDef read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// Reads a scene from text; `origin` is the name used in messages.
SceneDef parse_scene(const std::string& text, const std::string& origin,
                     const std::vector<std::string>& overrides = {});

/// Every key with its value, in schema order. This text is hashed and stored. Reading it gives the same scene.
std::string resolved_toml(const SceneDef& scene);

/// SHA-256 of resolved_toml, 64 hex digits: the identity of a case.
std::string scene_hash(const SceneDef& scene);

}  // namespace gem
