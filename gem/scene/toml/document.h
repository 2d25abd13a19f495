// A case document: one file with its includes and overrides laid over one another, not yet interpreted.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// Reads a case file; files named in `include` (relative to the including file) come first, later ones win.
/// `floes.path` becomes relative to the working directory. Throws Error(file_system) or Error(scene_rejected).
TomlNode load_document(const std::string& path);

/// The same from text, whose includes and paths are relative to the working directory.
TomlNode load_text(const std::string& text, const std::string& origin);

/// One override "key.path=value" in TOML syntax as a document of its own; a text of one word needs no quotes. Messages
/// name it "--set key.path=value"; an override "--option key.path=value" stands for that option and is named "--option
/// value".
TomlNode parse_override(const std::string& text);

/// Lays overrides over the document, in order.
void apply_overrides(TomlNode& document, const std::vector<std::string>& overrides);

}  // namespace gem
