// Reads and checks.
#include "gem/export/floe_record.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output/output_path.h"

namespace gem {
namespace {

[[noreturn]] void refuse_damaged(const RunFile& file, const std::string& why) {
  throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + why +
                                         "); the file may be damaged or made by another program");
}

}  // namespace

std::vector<double> whole_column(const RunFile& file, const std::string& dataset, std::size_t rows) {
  std::vector<double> values = file.column(dataset);
  if (values.size() != rows)
    refuse_damaged(file, dataset + " has " + std::to_string(values.size()) + " rows of " + std::to_string(rows));
  for (const double value : values)
    if (!std::isfinite(value)) refuse_damaged(file, dataset + " holds a value that is not a number");
  return values;
}

std::vector<double> ascending_column(const RunFile& file, const std::string& dataset) {
  std::vector<double> values = whole_column(file, dataset, file.rows(dataset));
  if (!std::is_sorted(values.begin(), values.end())) refuse_damaged(file, dataset + " does not ascend");
  return values;
}

std::vector<Vec2> placed(const std::vector<Vec2>& outline, Vec2 position, double angle_rad) {
  const Rotation turn{std::cos(angle_rad), std::sin(angle_rad)};
  std::vector<Vec2> corners;
  for (const Vec2 corner : outline) corners.push_back(position + rotate(turn, corner));
  return corners;
}

FloeRecord::FloeRecord(const RunFile& file) : file_(file), outlines_(file.floe_outlines()) {
  thickness_ = whole_column(file, "shape/thickness", count());
  mass_ = whole_column(file, "shape/mass", count());
  class_ = whole_column(file, "shape/class", count());
  times_ = ascending_column(file, "floes/time");
  for (const std::vector<Vec2>& outline : outlines_) {
    if (!file.is_floe_outline(outline))
      refuse_damaged(file, "an outline has " + std::to_string(outline.size()) + " corners");
    for (const Vec2 corner : outline)
      if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) refuse_damaged(file, "an outline is not finite");
  }
  if (times_.empty())
    throw Error(ExitCode::usage, shown(file.path()) + ": no frame of the floes (the run ended before the first) " +
                                     "run it again for at least one frame");
}

std::size_t FloeRecord::corner_count() const {
  std::size_t corners = 0;
  for (const std::vector<Vec2>& outline : outlines_) corners += outline.size();
  return corners;
}

std::vector<FrameFloe> FloeRecord::frame(std::size_t index) const {
  const FrameView view = file_.frame(index);
  if (view.x.size() != count())
    refuse_damaged(file_, "floes/x has " + std::to_string(view.x.size()) + " floes of " + std::to_string(count()));
  std::vector<FrameFloe> floes;
  for (std::size_t i = 0; i < count(); ++i) {
    if (view.active[i] == 0.0F) continue;
    if (outlines_[i].empty()) refuse_damaged(file_, "a floe has no outline");
    for (const float value : {view.x[i], view.y[i], view.theta[i], view.vx[i], view.vy[i], view.omega[i]})
      if (!std::isfinite(value))
        refuse_damaged(file_, "frame " + std::to_string(index) + " holds a value that is not a number");
    floes.push_back(
        {i, {view.x[i], view.y[i]}, placed(outlines_[i], {}, view.theta[i]), {view.vx[i], view.vy[i]}, view.omega[i]});
  }
  return floes;
}

std::size_t FloeRecord::nearest(double time_s) const {
  const double step = times_.size() > 1 ? times_[times_.size() - 1] - times_[times_.size() - 2] : 0.0;
  if (time_s > times_.back() + 0.5 * step + 1e-6)
    throw Error(ExitCode::usage, "--at " + number_text(time_s) + " s: no such frame (the record ends at " +
                                     number_text(times_.back()) + " s); choose an earlier time");
  const auto near = [time_s](double a, double b) { return std::fabs(a - time_s) < std::fabs(b - time_s); };
  return static_cast<std::size_t>(std::min_element(times_.begin(), times_.end(), near) - times_.begin());
}

}  // namespace gem
