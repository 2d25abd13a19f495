// The ice of one run as numbers: the floe set, the accumulation before the platform, the wake, the crowding in the
// channel.
#pragma once

#include "gem/record/run_file/run_file.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {

/// Adds the statistics of the floe set. For generated fields with a platform also how the ice is spread at the start,
/// at mid run and at the most crowded time.
void add_field_numbers(const RunFile& file, const SceneDef& scene, Numbers& numbers);

}  // namespace gem
