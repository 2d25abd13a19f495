// Rows of a sweep as JSON, for the manifest and for scripts.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "gem/command/sweep/folder/sweep_row.h"

namespace gem {

/// The rows as objects in a list.
nlohmann::ordered_json json_of(const std::vector<SweepRow>& rows);

/// One row. Throws exceptions of the JSON library or std::length_error if it is not one.
SweepRow row_of_json(const nlohmann::ordered_json& object);

}  // namespace gem
