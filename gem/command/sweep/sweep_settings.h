// The settings that tell the runs of a sweep apart, as columns of its summary.
#pragma once

#include <vector>

#include "gem/record/summary_file.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Seed, current speed, gap and ice thickness (mean over the classes by their tenths) in any case, then every option in
/// which the scenes differ, by its key; a pair as two columns KEY.x and KEY.y.
std::vector<SummaryColumn> setting_columns(const std::vector<SceneDef>& scenes);

}  // namespace gem
