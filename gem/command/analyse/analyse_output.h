// What `gem analyse` prints.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gem/command/analyse/analysed_runs.h"

namespace gem {

std::string text_of(const AnalysedRun& run);
std::string text_of(const std::vector<AnalysedRun>& runs, const CombinedRuns& all);

nlohmann::ordered_json json_of(const AnalysedRun& run);
nlohmann::ordered_json json_of(const std::vector<AnalysedRun>& runs, const CombinedRuns& all);

}  // namespace gem
