// The settings that distinguish the runs of a sweep, as columns of its summary.
#pragma once

#include <vector>

#include "gem/record/summary/summary_file.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Always: seed, current speed, gap and ice thickness (mean of the classes, weighted by their tenths). Then every
/// option that differs between the scenes, named by its key; a pair gives two columns KEY.x and KEY.y.
std::vector<SummaryColumn> setting_columns(const std::vector<SceneDef>& scenes);

}  // namespace gem
