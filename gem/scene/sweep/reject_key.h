// Refuses a key of a sweep file.
#pragma once

#include <string>

#include "gem/base/error.h"
#include "gem/scene/toml/toml_tree.h"

namespace gem {

/// Throws Error(scene_rejected) "place: key: problem".
[[noreturn]] inline void reject_key(const TomlPlace& place, const std::string& key, const std::string& problem) {
  throw Error(ExitCode::scene_rejected, to_string(place) + ": " + key + ": " + problem);
}

}  // namespace gem
