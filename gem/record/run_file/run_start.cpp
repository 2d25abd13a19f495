#include "gem/record/run_file/run_start.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/scene/schema/schema.h"

namespace gem {
namespace {

/// Half a unit in the last place of a single-precision number, relative.
constexpr double single_rounding = 0x1p-24;

/// Half the size of the smallest usual floe: beyond it a run says nothing about ice. Chosen by hand [m].
constexpr double overlap_maximum = 1.0;

[[noreturn]] void refuse(const RunFile& file, const std::string& why, const std::string& hint) {
  throw Error(ExitCode::file_system, "cannot begin with " + shown(file.path()) + " (" + why + ") " + hint);
}

/// Times of frames are sums of time steps, and people write them with few digits.
bool is_same_time(double a, double b) { return std::abs(a - b) <= 1e-6 * std::max(1.0, std::abs(b)); }

std::size_t frame_at(const RunFile& file, double time) {
  const std::vector<double> times = file.column("floes/time");
  if (times.empty()) refuse(file, "it holds no frame", "run it again for at least one floe frame");
  if (time == last_frame) return times.size() - 1;
  const auto closer = [time](double a, double b) { return std::abs(a - time) < std::abs(b - time); };
  const auto nearest = std::min_element(times.begin(), times.end(), closer);
  if (std::isfinite(*nearest) && is_same_time(*nearest, time)) return static_cast<std::size_t>(nearest - times.begin());
  refuse(file,
         "it has no frame at " + number_text(time, 9) + " s; its " + std::to_string(times.size()) +
             " frames are from " + number_text(times.front(), 9) + " s to " + number_text(times.back(), 9) + " s",
         "the nearest is at " + number_text(*nearest, 9) + " s");
}

double deepest_overlap(const RunFile& file) {
  double deepest = 0.0;
  const char* const name = file.has("stats/maximum_depth") ? "stats/maximum_depth" : "stats/maximum_overlap";
  for (const double overlap : file.column(name)) deepest = std::max(deepest, overlap);
  return deepest;
}

/// The deepest overlap that a correct file can show in any of its frames, see run_start.h.
double overlap_of(const RunFile& file, const std::vector<FloeDef>& floes) {
  double fastest = 0.0, farthest = 0.0;
  for (const FloeDef& floe : floes) {
    double radius = 0.0;
    for (const Vec2 corner : floe.outline_m) radius = std::max(radius, length(corner));
    fastest = std::max(fastest, length(floe.velocity_m_per_s) + radius * std::abs(floe.spin_rad_per_s));
    farthest = std::max(farthest, length(floe.position_m) + std::numbers::pi * radius);
  }
  const double closed = 2.0 * fastest * stored_scene(file).numerics.time_step_s;
  return std::min(deepest_overlap(file) + closed + 2.0 * single_rounding * farthest, overlap_maximum);
}

/// Throws if a column has another length than there are floes.
void check_lengths(const RunFile& file, std::size_t floes, std::initializer_list<std::size_t> lengths) {
  if (std::all_of(lengths.begin(), lengths.end(), [floes](std::size_t n) { return n == floes; })) return;
  refuse(file, "its columns of floes differ in length", "the file may be damaged");
}

/// Throws if a value of the file lies beyond what a case may say.
void check_range(const RunFile& file, const std::string& what, double value, const Range& range, const char* unit) {
  if (range.contains(value)) return;
  refuse(file, what + " is out of range (value " + number_text(value) + ", allowed " + range_text(range, unit) + ")",
         "the file may be damaged");
}

/// Outlines and places are checked where the case is, as those of listed floes.
void check_floes(const RunFile& file, const std::vector<FloeDef>& floes, const FrameView& frame) {
  for (std::size_t i = 0; i < floes.size(); ++i) {
    if (file.has_pieces() && frame.active[i] == 0.0f) continue;  // not made yet, or split
    const std::string name = "floe " + std::to_string(i) + ": ";
    check_range(file, name + "thickness", floes[i].thickness_m, thickness_range, "m");
    check_range(file, name + "speed", floes[i].velocity_m_per_s.x, speed_range, "m/s");
    check_range(file, name + "speed", floes[i].velocity_m_per_s.y, speed_range, "m/s");
    check_range(file, name + "spin", floes[i].spin_rad_per_s, spin_range, "rad/s");
  }
}

/// The floes with outline, place, and the speeds of `frame`; all of them, also those that have left.
std::vector<FloeDef> floes_at_start(const RunFile& file, const FrameView& frame) {
  const auto outlines = file.floe_outlines();
  const auto x = file.column("shape/start_x"), y = file.column("shape/start_y");
  const auto theta = file.column("shape/start_theta"), thickness = file.column("shape/thickness");
  const std::size_t n = outlines.size();
  check_lengths(file, n,
                {x.size(), y.size(), theta.size(), thickness.size(), frame.x.size(), frame.vx.size(), frame.vy.size(),
                 frame.omega.size(), frame.y.size(), frame.theta.size(), frame.active.size()});
  std::vector<FloeDef> floes(n);
  for (std::size_t i = 0; i < n; ++i)
    floes[i] = {outlines[i], {x[i], y[i]}, theta[i], {frame.vx[i], frame.vy[i]}, frame.omega[i], thickness[i]};
  return floes;
}

}  // namespace

FloesStart floes_of_run_file(const std::string& path, double time) {
  const RunFile file(path, true);
  if (file.floe_count() == 0) return {};
  const std::size_t index = frame_at(file, time);
  const FrameView frame = file.frame(index);
  FloesStart start{frame.time, floes_at_start(file, frame), 0.0};
  check_floes(file, start.floes, frame);
  if (index == 0 && !file.has_pieces()) return start;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < start.floes.size(); ++i) {
    if (frame.active[i] == 0.0f) continue;
    FloeDef& floe = start.floes[kept];
    if (kept != i) floe = std::move(start.floes[i]);
    floe.position_m = {frame.x[i], frame.y[i]};
    floe.angle_rad = frame.theta[i];
    ++kept;
  }
  start.floes.resize(kept);
  if (kept == 0) refuse(file, "all floes had left at " + number_text(frame.time) + " s", "choose an earlier frame");
  if (const double deepest = deepest_overlap(file); !(deepest <= overlap_maximum))
    refuse(file, "its bodies overlapped by up to " + number_text(deepest, 3) + " m", "look at its verdict: gem info");
  start.overlap = overlap_of(file, start.floes);
  return start;
}

std::optional<PlatformStart> platform_of_run_file(const std::string& path, double time) {
  const RunFile file(path, true);
  if (file.platform_outline().empty()) return std::nullopt;
  const std::vector<double> times = file.column("platform/time");
  std::size_t row = times.size();
  while (row > 0 && times[row - 1] > time && !is_same_time(times[row - 1], time)) --row;
  if (row == 0)
    refuse(file, "it has no sample of the platform up to " + number_text(time) + " s", "choose a later frame");
  const auto value = [&](const char* name) {
    const std::vector<double> column = file.column(std::string("platform/") + name);
    if (column.size() != times.size())
      refuse(file, "its columns of the platform differ in length", "it may be damaged");
    if (!std::isfinite(column[row - 1]))
      refuse(file, std::string("platform/") + name + " is not a number there", "it may be damaged");
    return column[row - 1];
  };
  const PlatformStart start{{value("x"), value("y")},
                            std::remainder(value("psi"), 2.0 * std::numbers::pi),
                            {value("vx"), value("vy")},
                            value("r")};
  check_range(file, "platform/x", start.position.x, place_range, "m");
  check_range(file, "platform/y", start.position.y, place_range, "m");
  check_range(file, "platform/vx", start.velocity.x, speed_range, "m/s");
  check_range(file, "platform/vy", start.velocity.y, speed_range, "m/s");
  check_range(file, "platform/r", start.spin, spin_range, "rad/s");
  return start;
}

}  // namespace gem
