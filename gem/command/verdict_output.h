// The verdict on a run as commands print it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "gem/record/verdict.h"

namespace gem {

/// One line per criterion that is not good: its grade, its name and its text.
std::string reasons_text(const RunVerdict& verdict, const std::string& indent);

/// A list with one object per criterion. Numbers that are not finite are null.
nlohmann::ordered_json criteria_json(const RunVerdict& verdict);

}  // namespace gem
