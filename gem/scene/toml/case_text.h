// Texts about cases for the command line: explanations, the JSON Schema, lists of sweeps.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/sweep/sweep.h"

namespace gem {

/// Every option with type, unit, default, range and meaning; of one section or one key if given.
/// Throws Error(usage) with the nearest name for an unknown key.
std::string explain(const std::string& key = "");

/// The options as a JSON list of objects.
std::string explain_json(const std::string& key = "");

/// The options as Markdown, one table per section. gem/manual/keys.md is this text.
std::string explain_markdown(const std::string& key = "");

/// JSON Schema of a case file, draft 4.
std::string json_schema();

/// A table with one line per run: index, name, differences.
std::string sweep_list_text(const std::vector<SweepMember>& members);

/// The runs as JSON, with the hash of each resolved case.
std::string sweep_list_json(const std::vector<SweepMember>& members);

}  // namespace gem
