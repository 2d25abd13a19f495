// The runs of the regression table: the case of each, its settings, and the contacts that it must have.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem::regression {

/// Contacts that a run must have. `platform`: contacts of the platform; `floes`: any contact.
enum class Touches { nothing, floes, platform };

/// One run of runs.txt.
struct ListedRun {
  std::string name;       // letters, digits and _
  std::string case_file;  // relative to the root of the repository
  std::string member;     // run of a sweep; empty if the file is a single case
  Touches touches = Touches::platform;
  std::vector<std::string> settings;  // "key=value" in TOML syntax, applied last
};

/// Reads a run list from text; `origin` is its name in messages. Throws std::runtime_error with the line of a mistake.
std::vector<ListedRun> parse_runs(const std::string& text, const std::string& origin);

/// The runs of validation/regression/runs.txt, in the order of the file. Throws as parse_runs.
std::vector<ListedRun> listed_runs();

/// The scene of a run. Throws gem::Error if the case or a setting is refused.
SceneDef scene_of(const ListedRun& run);

}  // namespace gem::regression
