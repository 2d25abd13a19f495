// The platform of a run file at given times.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/record/run_file/run_file.h"

namespace gem {

/// Motion and loads of the platform. Throws Error(file_system) if the file is damaged.
class PlatformTrack {
 public:
  explicit PlatformTrack(const RunFile& file);

  /// False for a run without a platform or before its first sample.
  bool present() const { return !times_.empty() && !pieces_.empty() && pieces_[0].size() >= 3; }
  const std::vector<double>& times() const { return times_; }  // ascending [s]
  /// The last sample at or before a time; the first one before all.
  std::size_t sample_at(double time_s) const;
  /// A column of /platform, e.g. "psi", or the vector of columns such as "ice_force_x" and "ice_force_y".
  double value(const std::string& name, std::size_t sample) const { return columns_.at(name)[sample]; }
  Vec2 vector(const std::string& name, std::size_t sample) const;
  Vec2 position(std::size_t sample) const { return {value("x", sample), value("y", sample)}; }
  /// The outlines of its pieces in the world [m].
  std::vector<std::vector<Vec2>> outlines(std::size_t sample) const;
  /// The same with the yaw of t = 0 [m].
  std::vector<std::vector<Vec2>> unturned_outlines(std::size_t sample) const;

 private:
  std::vector<std::vector<Vec2>> outlines_with(std::size_t sample, double yaw) const;

  std::vector<std::vector<Vec2>> pieces_;
  std::vector<double> times_;
  std::map<std::string, std::vector<double>> columns_;
};

}  // namespace gem
