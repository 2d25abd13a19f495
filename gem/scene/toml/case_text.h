// What the command line says about cases: explanations, the JSON Schema, resolved text, lists of sweeps.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/sweep/sweep.h"

namespace gem {

/// Every option with type, unit, default, range and meaning; of one section or one key if given.
/// Throws Error(usage) with the nearest name for an unknown key.
std::string explain(const std::string& key = "");

/// The same as JSON: a list of objects.
std::string explain_json(const std::string& key = "");

/// The same as Markdown: a page with a table for each section. gem/manual/keys.md is this text.
std::string explain_markdown(const std::string& key = "");

/// JSON Schema of a case file, of draft 4 features only.
std::string json_schema();

/// A table with one line per run: index, name, differences.
std::string sweep_list_text(const std::vector<SweepMember>& members);

/// The same as JSON, with the hash of each resolved case.
std::string sweep_list_json(const std::vector<SweepMember>& members);

}  // namespace gem
