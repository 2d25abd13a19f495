// What the command line says about cases: explanations, the JSON Schema, resolved text, lists of sweeps.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "gem/scene/sweep.h"

namespace gem {

/// Every option with type, unit, default, range and meaning; of one section or one key if given.
/// Throws Error(usage) with the nearest name for an unknown key.
std::string explain(const std::string& key = "");

/// The same as JSON: a list of objects.
std::string explain_json(const std::string& key = "");

/// JSON Schema of a case file, of draft 4 features only.
std::string json_schema();

/// A table with one line per run: index, name, differences.
std::string sweep_list_text(const std::vector<SweepMember>& members);

/// The same as JSON, with the hash of each resolved case.
std::string sweep_list_json(const std::vector<SweepMember>& members);

// The commands: print to `out`, faults to `err`, and return the exit code.
int explain_command(const std::string& key, bool json, std::ostream& out, std::ostream& err);
int schema_command(std::ostream& out);
int resolve_command(const std::string& path, const std::vector<std::string>& overrides, std::ostream& out,
                    std::ostream& err);
int sweep_list_command(const std::string& path, const std::vector<std::string>& overrides, bool json, std::ostream& out,
                       std::ostream& err);

}  // namespace gem
