// Where everything is at any time of a run: between two frames by a cubic curve, as on the page of gem view.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/record/run_file/run_file.h"

namespace gem::film {

struct FloePose {
  bool there = false;
  Vec2 position;       // centroid [m]
  double angle = 0.0;  // [rad]
  double speed = 0.0;  // [m/s]
};

struct PlatformPose {
  Vec2 position;            // [m]
  double angle = 0.0;       // [rad]
  Vec2 ice_force, mooring;  // means as recorded [N]
};

/// Everything throws Error(file_system) if the file is damaged. `file` must outlive this object.
class FilmPoses {
 public:
  explicit FilmPoses(const RunFile& file);

  double end() const { return times_.empty() ? 0.0 : times_.back(); }  // last frame [s]
  bool has_platform() const { return has_platform_; }
  std::vector<FloePose> floes_at(double time);
  PlatformPose platform_at(double time) const;
  /// Time of the frame nearest to `time` [s].
  double frame_time(double time) const;

 private:
  std::size_t before(const std::vector<double>& times, double time) const;
  const FrameView& frame(std::size_t index);

  const RunFile& file_;
  std::vector<double> times_;
  std::vector<FrameView> kept_;  // frames from kept_first_ on
  std::size_t kept_first_ = 0;
  bool has_platform_ = false;
  std::vector<double> platform_times_;
  std::vector<std::vector<double>> platform_;  // by column
};

}  // namespace gem::film
