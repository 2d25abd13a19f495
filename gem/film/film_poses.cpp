// Reads some frames at a time, since they are compressed together.
#include "gem/film/film_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"

namespace gem::film {

namespace {

constexpr std::size_t frames_read = 16;
const char* const columns[] = {
    "x", "y", "psi", "ice_force_mean_x", "ice_force_mean_y", "mooring_force_x", "mooring_force_y"};

/// A curve through p and q with the slopes u and v over `seconds`, at the share s of the way.
double between(double p, double u, double q, double v, double seconds, double s) {
  const double t = s * s, c = t * s;
  return (2 * c - 3 * t + 1) * p + (c - 2 * t + s) * seconds * u + (3 * t - 2 * c) * q + (c - t) * seconds * v;
}

/// The angle of the later frame, counted on over the turns that the spin leads to.
double counted_on(double from, double to, double spin, double seconds) {
  constexpr double turn = 2.0 * std::numbers::pi;
  return to - turn * std::round((to - from - spin * seconds) / turn);
}

}  // namespace

FilmPoses::FilmPoses(const RunFile& file) : file_(file), times_(file.column("floes/time")) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::file_system, "cannot read " + shown(file.path()) + " (" + why + "); the file may be damaged");
  };
  if (!std::is_sorted(times_.begin(), times_.end())) refuse("floes/time does not ascend");
  has_platform_ = file.platform_outline().size() >= 3 && file.has("platform/time") && file.rows("platform/time") > 0;
  if (!has_platform_) return;
  platform_times_ = file.column("platform/time");
  for (const char* name : columns) {
    platform_.push_back(file.column(std::string("platform/") + name));
    if (platform_.back().size() != platform_times_.size()) refuse("columns of the platform differ in length");
  }
}

std::size_t FilmPoses::before(const std::vector<double>& times, double time) const {
  const auto above = std::upper_bound(times.begin(), times.end(), time);
  return above == times.begin() ? 0 : static_cast<std::size_t>(above - times.begin()) - 1;
}

double FilmPoses::frame_time(double time) const {
  if (times_.empty()) return time;
  const std::size_t n = before(times_, time);
  return n + 1 < times_.size() && times_[n + 1] - time < time - times_[n] ? times_[n + 1] : times_[n];
}

const FrameView& FilmPoses::frame(std::size_t index) {
  if (kept_.empty() || index < kept_first_ || index >= kept_first_ + kept_.size()) {
    kept_first_ = index;
    kept_ = file_.frames(index, std::min(frames_read, times_.size() - index));
  }
  return kept_[index - kept_first_];
}

std::vector<FloePose> FilmPoses::floes_at(double time) {
  if (times_.empty()) return {};
  const std::size_t n = before(times_, time);
  const FrameView a = frame(n), b = frame(std::min(n + 1, times_.size() - 1));
  const double seconds = b.time - a.time;
  const double s = seconds > 0.0 ? std::clamp((time - a.time) / seconds, 0.0, 1.0) : 0.0;
  std::vector<FloePose> floes(a.x.size());
  for (std::size_t i = 0; i < floes.size(); ++i) {
    FloePose& pose = floes[i];
    if (a.active[i] == 0.0F) continue;
    const bool both = b.active[i] != 0.0F;  // a floe that leaves stays where it was
    const FrameView& to = both ? b : a;
    const double way = both ? s : 0.0;
    pose.position = {between(a.x[i], a.vx[i], to.x[i], to.vx[i], seconds, way),
                     between(a.y[i], a.vy[i], to.y[i], to.vy[i], seconds, way)};
    const double later = counted_on(a.theta[i], to.theta[i], 0.5 * (a.omega[i] + to.omega[i]), both ? seconds : 0.0);
    pose.angle = between(a.theta[i], a.omega[i], later, to.omega[i], seconds, way);
    pose.speed = (1.0 - way) * std::hypot(a.vx[i], a.vy[i]) + way * std::hypot(to.vx[i], to.vy[i]);
    pose.there = std::isfinite(pose.position.x + pose.position.y + pose.angle + pose.speed);
  }
  return floes;
}

PlatformPose FilmPoses::platform_at(double time) const {
  const std::size_t i = before(platform_times_, time), j = std::min(i + 1, platform_times_.size() - 1);
  const double seconds = platform_times_[j] - platform_times_[i];
  const double s = seconds > 0.0 ? std::clamp((time - platform_times_[i]) / seconds, 0.0, 1.0) : 0.0;
  const auto at = [&](std::size_t c) { return platform_[c][i] + s * (platform_[c][j] - platform_[c][i]); };
  return {{at(0), at(1)}, at(2), {at(3), at(4)}, {at(5), at(6)}};
}

}  // namespace gem::film
