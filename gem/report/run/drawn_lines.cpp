// Places the mooring lines of a run.
#include "gem/report/run/drawn_lines.h"

#include <algorithm>
#include <cmath>

#include "gem/record/line_tensions.h"
#include "gem/report/run/line_record.h"
#include "gem/scene/scene_mooring.h"

namespace gem {

DrawnLines::DrawnLines(const RunFile& file, const SceneDef& scene) {
  if (!has_lines(scene)) return;
  tables_ = mooring_tables(scene);
  break_times_ = last_break_times(file, scene);
  break_times_.resize(tables_.branch.size(), 0.0);
  for (const double tension : line_tensions_at_start(scene)) usual_tension_ = std::max(usual_tension_, tension);
}

std::vector<DrawnLine> DrawnLines::at(Vec2 position, double angle, double time) const {
  const Rotation q = {std::cos(angle), std::sin(angle)};
  const MooringView view = tables_.view();
  std::vector<DrawnLine> lines;
  for (std::size_t k = 0; k < tables_.branch.size(); ++k) {
    const MooringBranch& branch = tables_.branch[k];
    const LineReach reach = line_reach(branch, position, q);
    DrawnLine line{position + reach.arm, branch.anchor, 0.0, LineState::holds};
    if (break_times_[k] > 0.0 && time >= break_times_[k]) {
      line.state = LineState::broken;
    } else {
      const CurvePoint point = branch_at(view, branch, length(reach.reach));
      line.tension = point.beside;
      if (point.force <= 0.0) line.state = LineState::slack;
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace gem
