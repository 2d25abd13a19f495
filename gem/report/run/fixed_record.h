// The forces on the [[fixed]] bodies of a case, from the forces between bodies at the floe frames.
#pragma once

#include <string>
#include <vector>

#include "gem/analysis/run_analysis.h"
#include "gem/base/vec2.h"
#include "gem/record/run_file/run_file.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Forces in world axes, each the mean over one time step: the last before its frame.
struct FixedRecord {
  std::vector<double> time;              // of the frames after the start [s]
  std::vector<std::vector<Vec2>> force;  // by body of [[fixed]], then by frame [N]
};

/// Empty for a case without [[fixed]] and for a run without output.contact_forces. Throws Error(file_system) if the
/// file is damaged.
FixedRecord fixed_record(const RunFile& file, const SceneDef& scene);

/// Mean along x and y with intervals, and the largest force at a frame, of each body and of all together, from `from_s`
/// on; none with fewer than two frames. An interval takes stretches of a twentieth of the record as independent.
std::vector<Finding> fixed_findings(const FixedRecord& fixed, double from_s);

}  // namespace gem
