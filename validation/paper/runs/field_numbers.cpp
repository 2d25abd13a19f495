// Ice cover on grids of cells, from the frames of a run.
#include "validation/paper/runs/field_numbers.h"

#include <algorithm>
#include <cmath>

#include "gem/analysis/concentration.h"
#include "gem/analysis/statistics/moments.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

constexpr std::size_t kFrames = 60;  // number of frames that are read
constexpr double kFineCell = 10.0;   // ahead of the platform [m]
constexpr double kWideCell = 20.0;   // a few floes each: the scatter of their covers shows clusters [m]

using Outlines = std::vector<std::vector<Vec2>>;

void add_floe_set(const Outlines& outlines, const SceneDef& scene, Numbers& numbers) {
  std::vector<double> sizes;
  double most_sides = 0.0;
  double typical = 0.0;
  double area = 0.0;
  for (const std::vector<Vec2>& outline : outlines) {
    const double own = polygon_moments(outline).area;
    area += own;
    sizes.push_back(std::sqrt(own));
    most_sides = std::max(most_sides, static_cast<double>(outline.size()));
    typical += outline.size() >= 4 && outline.size() <= 7 ? 1.0 : 0.0;
  }
  const Moments about = moments(sizes);
  numbers.add("floe_count", static_cast<double>(outlines.size()));
  numbers.add("floe_size_mean_m", about.mean);
  numbers.add("floe_size_deviation_m", about.deviation);
  numbers.add("floe_size_smallest_m", about.minimum);
  numbers.add("floe_size_largest_m", about.maximum);
  numbers.add("floe_sides_most", most_sides);
  numbers.add("floe_sides_4_to_7_share", typical / static_cast<double>(outlines.size()));
  numbers.add("cover_start", area / (scene.floes.length_m * scene.floes.width_m));
}

struct Rectangle {
  double x_low, x_high, y_low, y_high;
};

/// Cover of every cell of a rectangle.
std::vector<double> cover(const FrameView& frame, const Outlines& outlines, const Rectangle& where, double cell) {
  std::vector<PlacedFloe> floes;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const bool near = frame.x[i] > where.x_low - 40.0F && frame.x[i] < where.x_high + 40.0F;
    if (frame.active[i] != 0.0F && near) floes.push_back({outlines[i], {frame.x[i], frame.y[i]}, frame.theta[i]});
  }
  const auto cells = [cell](double low, double high) {
    return static_cast<std::size_t>(std::max(1.0, std::round((high - low) / cell)));
  };
  return concentration(
             floes,
             {{where.x_low, where.y_low}, cell, cells(where.x_low, where.x_high), cells(where.y_low, where.y_high)})
      .share;
}

double median_speed(const FrameView& frame) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i < frame.x.size(); ++i)
    if (frame.active[i] != 0.0F) speeds.push_back(std::hypot(frame.vx[i], frame.vy[i]));
  return percentile(speeds, 0.5);
}

/// The part of the field that is still far upstream at `time` if the ice drifts with the current.
Rectangle upstream(const SceneDef& scene, double time) {
  const double tail = scene.floes.start_x_m + scene.current.velocity_m_per_s.x * time;
  const double half = 0.5 * scene.floes.width_m - kWideCell;
  return {tail + 0.1 * scene.floes.length_m, tail + 0.3 * scene.floes.length_m, -half, half};
}

double spread(const std::vector<double>& covers) {
  const Moments about = moments(covers);
  return about.deviation / about.mean;
}

/// Time by which half of the floes drift at nine tenths of the current speed, over the duration of the run.
void add_spin_up(const RunFile& file, const SceneDef& scene, Numbers& numbers) {
  const double wanted = 0.9 * length(scene.current.velocity_m_per_s);
  for (std::size_t i = 0; i < file.frame_count(); ++i) {
    const FrameView frame = file.frame(i);
    if (median_speed(frame) < wanted) continue;
    return numbers.add("time_to_drift_share", frame.time / scene.run.duration_s);
  }
}

/// Largest cover of any frame just upstream of the platform, and over the width of the channel there.
void add_crowding(const RunFile& file, const SceneDef& scene, const Outlines& outlines, Numbers& numbers) {
  const double radius = 0.5 * scene.platform.diameter_m;
  const double bow = scene.platform.anchor_m.x - radius;
  const double half_gap = 0.5 * scene.boundary.gap_m;
  double plug = 0.0;
  double across = 0.0;
  const std::size_t frames = file.frame_count();
  for (std::size_t i = 0; i < frames; i += std::max<std::size_t>(1, frames / kFrames)) {
    const FrameView frame = file.frame(i);
    plug = std::max(plug, moments(cover(frame, outlines, {bow - radius, bow, -radius, radius}, kFineCell)).mean);
    if (scene.boundary.present)
      across = std::max(
          across, moments(cover(frame, outlines, {bow - 2.0 * radius, bow, -half_gap, half_gap}, kFineCell)).mean);
  }
  numbers.add("cover_ahead_largest", plug);
  if (scene.boundary.present) numbers.add("cover_across_largest", across);
  if (const auto start = numbers.find("cover_start")) numbers.add("plug_over_start", plug / start->value);
}

/// At mid run: whether the ice upstream is as evenly spread as at the start, and the ice downstream of the platform
/// less.
void add_spreading(const RunFile& file, const SceneDef& scene, const Outlines& outlines, Numbers& numbers) {
  const FrameView first = file.frame(0);
  const FrameView middle = file.frame(file.frame_count() / 2);
  const double start = spread(cover(first, outlines, upstream(scene, 0.0), kWideCell));
  const Rectangle later = upstream(scene, middle.time);
  const double stern = scene.platform.anchor_m.x + 0.5 * scene.platform.diameter_m;
  if (later.x_high < scene.platform.anchor_m.x - 2.0 * scene.platform.diameter_m)
    numbers.add("upstream_spread_over_start", spread(cover(middle, outlines, later, kWideCell)) / start);
  const Rectangle wake{stern + 10.0, scene.output.retire_x_m - 20.0, later.y_low, later.y_high};
  const std::vector<double> covers = cover(middle, outlines, wake, kWideCell);
  if (moments(covers).mean > 0.05) numbers.add("wake_spread_over_start", spread(covers) / start);
}

}  // namespace

void add_field_numbers(const RunFile& file, const SceneDef& scene, Numbers& numbers) {
  const Outlines outlines = file.floe_outlines();
  const bool made = scene.floes.source == FloeSource::generated || scene.floes.source == FloeSource::copied;
  if (outlines.empty() || !made) return;
  add_floe_set(outlines, scene, numbers);
  if (!scene.platform.present || file.frame_count() < 3) return;
  add_spin_up(file, scene, numbers);
  add_crowding(file, scene, outlines, numbers);
  add_spreading(file, scene, outlines, numbers);
}

}  // namespace gem
