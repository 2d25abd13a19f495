// First stage of a sweep: its table becomes a list of names and settings.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/toml/toml_tree.h"

namespace gem {

inline constexpr std::size_t members_maximum = 100000;  // of a sweep

/// One run before it is read: settings to merge over the rest of the file.
struct SweepDraft {
  std::string name;
  TomlNode settings;
};

/// All runs of a [sweep] table in order. Throws Error(scene_rejected) with the place of the fault.
std::vector<SweepDraft> make_sweep_drafts(const TomlNode& sweep);

}  // namespace gem
