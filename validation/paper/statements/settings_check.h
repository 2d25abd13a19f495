// Checks that compared runs differ only in what the comparison is about.
#pragma once

#include <string>
#include <vector>

#include "validation/paper/runs/paper_run.h"
#include "validation/paper/statements/catalogue.h"

namespace gem {

/// Options whose values differ between two scenes; names, seeds and output options are left out.
std::vector<std::string> differing_options(const SceneDef& a, const SceneDef& b);

/// Settings that should be equal and are not: any within one condition; between the runs of the tables, those that the
/// tables do not vary. One sentence each; empty if there are none.
std::vector<std::string> mixed_settings(const PaperFolder& folder, const std::vector<TableRow>& rows);

}  // namespace gem
