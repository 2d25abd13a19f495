// Do runs that are compared differ only by what the comparison is about?
#pragma once

#include <string>
#include <vector>

#include "validation/paper/runs/paper_run.h"
#include "validation/paper/statements/catalogue.h"

namespace gem {

/// Options whose values differ between two scenes; names, seeds and output options are left out.
std::vector<std::string> differing_options(const SceneDef& a, const SceneDef& b);

/// Settings that should be alike and are not: within one condition anything, between the runs of the tables anything
/// that the tables do not vary. One sentence each, empty for a sound folder.
std::vector<std::string> mixed_settings(const PaperFolder& folder, const std::vector<TableRow>& rows);

}  // namespace gem
