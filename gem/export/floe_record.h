// The floes of a run file by frame, checked: what an export draws.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/record/run_file/run_file.h"

namespace gem {

/// A floe that takes part in a frame.
struct FrameFloe {
  std::size_t index = 0;      // in /shape and /floes
  Vec2 position;              // centroid [m]
  std::vector<Vec2> outline;  // corners about the centroid, turned as in the frame, counter-clockwise [m]
  Vec2 velocity;              // [m/s]
  double spin = 0.0;          // [rad/s]
};

/// Shapes and frames of the floes. Everything throws Error(file_system) if the file is damaged.
class FloeRecord {
 public:
  explicit FloeRecord(const RunFile& file);

  const std::vector<double>& times() const { return times_; }  // of the frames, ascending [s]
  double thickness(std::size_t floe) const { return thickness_[floe]; }
  double mass(std::size_t floe) const { return mass_[floe]; }
  int ice_class(std::size_t floe) const { return static_cast<int>(class_[floe]); }
  std::size_t corner_count() const;  // of all floes
  std::size_t count() const { return outlines_.size(); }

  /// The active floes of a frame, in the order of the file.
  std::vector<FrameFloe> frame(std::size_t index) const;
  /// Index of the frame nearest to a time [s]. Throws Error(usage) if the record ends before.
  std::size_t nearest(double time_s) const;

 private:
  const RunFile& file_;
  std::vector<std::vector<Vec2>> outlines_;
  std::vector<double> thickness_, mass_, class_, times_;
};

/// A column of a group, as long as `rows` and finite. Throws Error(file_system) otherwise.
std::vector<double> whole_column(const RunFile& file, const std::string& dataset, std::size_t rows);

/// The same with ascending values.
std::vector<double> ascending_column(const RunFile& file, const std::string& dataset);

/// The corners of an outline about `position`, turned by `angle` [rad].
std::vector<Vec2> placed(const std::vector<Vec2>& outline, Vec2 position, double angle_rad);

}  // namespace gem
