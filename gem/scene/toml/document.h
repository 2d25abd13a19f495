// A case document: one file merged with its includes and overrides, not yet interpreted.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// Reads a case file. Files named in `include` (relative to the including file) are merged first; later values win.
/// `floes.path` becomes relative to the working directory. Throws Error(file_system) or Error(scene_rejected).
TomlNode load_document(const std::string& path);

/// Reads a document from text. It opens no file: include is refused. Paths are relative to the working directory.
TomlNode load_text(const std::string& text, const std::string& origin);

/// Parses one override "key.path=value" in TOML syntax; a text of one word needs no quotes. Messages call it "--set
/// key.path=value". An override "--option key.path=value" comes from that option; messages call it "--option value".
TomlNode parse_override(const std::string& text);

/// Merges overrides over the document, in order.
void apply_overrides(TomlNode& document, const std::vector<std::string>& overrides);

}  // namespace gem
