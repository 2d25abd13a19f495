// The ice of one run as numbers: the floe set, the plug, the wake, the crowd between the boundaries.
#pragma once

#include "gem/record/run_file.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {

/// Adds the statistics of the floe set, and for generated fields with a platform how the ice is spread at the start, in
/// between and at the most crowded time.
void add_field_numbers(const RunFile& file, const SceneDef& scene, Numbers& numbers);

}  // namespace gem
