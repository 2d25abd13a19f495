// Scenes in TOML: read, override, check, write back.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/scene_def.h"
#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// Reads and checks a case file with its includes; `overrides` are "key.path=value" in TOML syntax, applied last.
/// Paths in the case are made relative to the case file. Throws Error(scene_rejected) listing every problem with
/// file:line:column, Error(file_system) if a file cannot be read.
SceneDef read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// The scene of a document from load_document(), with overrides.
SceneDef scene_of(TomlNode document, const std::vector<std::string>& overrides = {});

/// Reads a scene from text, which may come from anybody: it opens no file. `origin` is the name used in messages.
SceneDef parse_scene(const std::string& text, const std::string& origin,
                     const std::vector<std::string>& overrides = {});

/// Every key with its value, in schema order. This text is hashed and stored. Reading it gives the same scene.
std::string resolved_toml(const SceneDef& scene);

/// The identity of a case from its resolved text: SHA-256, 64 hex digits. If the text names the floes of a file by
/// their SHA-256, the line with the path of that file does not count: the floes matter, not where they lie.
std::string case_hash(const std::string& resolved_text);

/// case_hash of resolved_toml.
std::string scene_hash(const SceneDef& scene);

/// SHA-256 of floes: outlines, places, velocities and thicknesses to the last bit. Two files with the same floes have
/// the same hash.
std::string floes_sha256(const std::vector<FloeDef>& floes);

/// Throws Error(scene_rejected) if the scene names its floes by SHA-256 and these are others.
void check_same_floes(const SceneDef& scene, const std::vector<FloeDef>& floes);

}  // namespace gem
