// Computes the numbers of one member of an ensemble from its run file.
#include "validation/baseline/ensemble_rows.h"

#include <algorithm>
#include <cmath>

#include "gem/analysis/spectra/period.h"
#include "gem/analysis/statistics/moments.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "validation/baseline/platform_events.h"

namespace gem::baseline {
namespace {

/// Samples [first, last) with from <= time <= to.
struct Span {
  std::size_t first = 0, last = 0;
};

Span span_of(const std::vector<double>& time, const PlannedCase& chosen) {
  const auto first = std::lower_bound(time.begin(), time.end(), chosen.from_s - 1e-6);
  const auto last = std::upper_bound(time.begin(), time.end(), chosen.to_s + 1e-6);
  return {static_cast<std::size_t>(first - time.begin()), static_cast<std::size_t>(last - time.begin())};
}

std::vector<double> cut(const std::vector<double>& column, Span span) {
  return {column.begin() + static_cast<std::ptrdiff_t>(span.first),
          column.begin() + static_cast<std::ptrdiff_t>(span.last)};
}

class MemberFile {
 public:
  MemberFile(const std::string& path, const PlannedCase& chosen)
      : file_(path), chosen_(chosen), scene_(stored_scene(file_)) {
    const std::vector<double> time = file_.column("platform/time");
    platform_ = span_of(time, chosen);
    if (platform_.last < platform_.first + 200 || time.back() < chosen.to_s - 1.0)
      throw Error(ExitCode::usage, path + ": ends at " + number_text(time.empty() ? 0.0 : time.back(), 6) +
                                       " s (judged until " + number_text(chosen.to_s) + " s); run it to its end");
    interval_ = time[1] - time[0];
  }

  std::vector<MemberValue> values() const {
    std::vector<MemberValue> all;
    add_motion(all, "x", scene_.platform.anchor_m.x);
    add_motion(all, "y", scene_.platform.anchor_m.y);
    const std::vector<double> force = cut(file_.column("platform/ice_force_mean_x"), platform_);
    all.push_back({"ice_force_x_mean_N", moments(force).mean});
    all.push_back({"ice_force_1s_deviation_N", moments(force).deviation});
    all.push_back({"ice_force_1s_p99_N", percentile(force, 0.99)});
    add_hits(all);
    all.push_back({"energy_loss_W", energy_loss()});
    const std::vector<double> wall = file_.column("stats/wall_time"), time = file_.column("stats/time");
    all.push_back({"wall_s_per_s", wall.back() / time.back()});
    const std::vector<double> overlap = file_.column("stats/maximum_overlap");
    all.push_back({"maximum_overlap_m", *std::max_element(overlap.begin(), overlap.end())});
    return all;
  }

  /// Mean share of each cell over the judged frames.
  std::vector<double> map(const Grid& grid) const {
    const Span frames = span_of(file_.column("floes/time"), chosen_);
    const auto outlines = file_.floe_outlines();
    std::vector<double> mean(grid.columns * grid.rows, 0.0);
    if (frames.first == frames.last)
      throw Error(ExitCode::usage, file_.path() + ": no frame of the floes in the judged time (too rare); write more");
    for (std::size_t k = frames.first; k < frames.last; ++k) {
      const FrameView frame = file_.frame(k);
      std::vector<PlacedFloe> floes;
      for (std::size_t i = 0; i < outlines.size(); ++i)
        if (frame.active[i] != 0.0f) floes.push_back({outlines[i], {frame.x[i], frame.y[i]}, frame.theta[i]});
      const Concentration now = concentration(floes, grid);
      for (std::size_t c = 0; c < mean.size(); ++c)
        mean[c] += now.share[c] / static_cast<double>(frames.last - frames.first);
    }
    return mean;
  }

  const SceneDef& scene() const { return scene_; }

 private:
  void add_motion(std::vector<MemberValue>& all, const std::string& axis, double rest) const {
    std::vector<double> path = cut(file_.column("platform/" + axis), platform_);
    for (double& value : path) value -= rest;
    all.push_back({"offset_" + axis + "_mean_m", moments(path).mean});
    all.push_back({"offset_" + axis + "_deviation_m", moments(path).deviation});
    const auto period = spectral_period(eigenspectra(path, interval_));
    all.push_back({"period_" + axis + "_s", period ? period->period : std::nan("")});
  }

  /// Impacts are events faster than the default event speed. A hit is the first impact of a floe after a second without
  /// one, because gem takes most hits in two time steps. A landing is the first event of any speed after
  /// `landing_gap_s`; NaN if the file holds no slow events.
  void add_hits(std::vector<MemberValue>& all) const {
    const PlatformEvents touches = platform_events(file_);
    const PlatformEvents impacts = faster_than(OutputDef{}.event_speed_m_per_s, touches);
    const auto per_second = [&](const char* name, const PlatformEvents& events, double gap) {
      all.push_back({name, first_after(gap, events, chosen_.from_s, chosen_.to_s) / (chosen_.to_s - chosen_.from_s)});
    };
    per_second("impacts_per_s", impacts, 0.0);
    per_second("hits_per_s", impacts, 1.0);
    per_second("landings_per_s", touches, landing_gap_s);
    if (scene_.output.event_speed_m_per_s > 0.0) all.back().value = std::nan("");
  }

  /// Mean power that contacts took from the floes and the platform.
  double energy_loss() const {
    const std::vector<double> time = file_.column("stats/time");
    const Span rows = span_of(time, chosen_);
    double lost = 0.0;
    for (const char* channel : {"impact", "friction", "elastic"}) {
      const std::vector<double> energy = file_.column(std::string("stats/energy_") + channel);
      lost += energy[rows.first] - energy[rows.last - 1];
    }
    return lost / (time[rows.last - 1] - time[rows.first]);
  }

  RunFile file_;
  const PlannedCase& chosen_;
  SceneDef scene_;
  Span platform_;
  double interval_ = 0.0;
};

/// Mean share of the cells whose centres lie in the box.
double share_in(const std::vector<double>& share, const Grid& grid, Vec2 low, Vec2 high) {
  double sum = 0.0, count = 0.0;
  for (std::size_t row = 0; row < grid.rows; ++row)
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2 centre =
          grid.corner + grid.cell * Vec2{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
      if (centre.x < low.x || centre.x > high.x || centre.y < low.y || centre.y > high.y) continue;
      sum += share[row * grid.columns + column];
      count += 1.0;
    }
  return count > 0.0 ? sum / count : std::nan("");
}

}  // namespace

MemberRows member_rows(const std::string& run_file, const PlannedCase& chosen, const Grid& grid) {
  const MemberFile file(run_file, chosen);
  MemberRows rows{static_cast<int>(file.scene().run.seed), file.scene().numerics.time_step_s, file.values(),
                  file.map(grid)};
  const double half = 0.5 * file.scene().platform.diameter_m;
  rows.values.push_back({"share_upstream", share_in(rows.share, grid, {-6.0 * half, -half}, {-half, half})});
  rows.values.push_back({"share_wake", share_in(rows.share, grid, {half, -half}, {2.0 * half, half})});
  const double upper = share_in(rows.share, grid, {-half, half}, {half, 2.0 * half}),
               lower = share_in(rows.share, grid, {-half, -2.0 * half}, {half, -half});
  rows.values.push_back({"share_sides", 0.5 * (upper + lower)});
  return rows;
}

}  // namespace gem::baseline
