// Where the mooring lines of a run are at a time and what they hold, for pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/record/run_file/run_file.h"
#include "gem/scene/scene_def.h"

namespace gem {

enum class LineState { holds, slack, broken };

/// A mooring line seen from above.
struct DrawnLine {
  Vec2 fairlead, anchor;  // world [m]
  double tension = 0.0;   // at the fairlead [N]; 0: broken
  LineState state = LineState::holds;
};

/// The lines of a run. Tensions follow from the pose of the platform, as in the run itself.
class DrawnLines {
 public:
  /// No lines for a run without them. Throws Error(file_system) if their columns are damaged.
  DrawnLines(const RunFile& file, const SceneDef& scene);

  const MooringTables& tables() const { return tables_; }
  /// Of each line; 0: it held [s].
  const std::vector<double>& break_times() const { return break_times_; }
  /// Largest tension at t = 0: lines are drawn as wide as theirs is beside it [N].
  double usual_tension() const { return usual_tension_; }
  std::vector<DrawnLine> at(Vec2 position, double angle, double time) const;

 private:
  MooringTables tables_;
  std::vector<double> break_times_;
  double usual_tension_ = 1.0;
};

}  // namespace gem
