// Reads the platform's columns once.
#include "gem/export/platform_track.h"

#include <algorithm>

#include "gem/export/floe_record.h"

namespace gem {

PlatformTrack::PlatformTrack(const RunFile& file) {
  if (!file.has("platform/time") || !file.has("shape/platform_xy")) return;
  pieces_ = file.platform_pieces();
  times_ = ascending_column(file, "platform/time");
  for (const char* name : {"x", "y", "psi", "vx", "vy", "r", "ice_force_x", "ice_force_y", "ice_force_mean_x",
                           "ice_force_mean_y", "mooring_force_x", "mooring_force_y", "drag_force_x", "drag_force_y"})
    columns_[name] = whole_column(file, std::string("platform/") + name, times_.size());
}

std::size_t PlatformTrack::sample_at(double time_s) const {
  // Frames and samples sum the same time steps, but not in the same order.
  const auto next = std::upper_bound(times_.begin(), times_.end(), time_s + 1e-6 * (1.0 + time_s));
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, next - times_.begin())) - 1;
}

Vec2 PlatformTrack::vector(const std::string& name, std::size_t sample) const {
  return {value(name + "_x", sample), value(name + "_y", sample)};
}

std::vector<std::vector<Vec2>> PlatformTrack::outlines_with(std::size_t sample, double yaw) const {
  std::vector<std::vector<Vec2>> outlines;
  for (const std::vector<Vec2>& piece : pieces_) outlines.push_back(placed(piece, position(sample), yaw));
  return outlines;
}

std::vector<std::vector<Vec2>> PlatformTrack::outlines(std::size_t sample) const {
  return outlines_with(sample, value("psi", sample));
}

std::vector<std::vector<Vec2>> PlatformTrack::unturned_outlines(std::size_t sample) const {
  return outlines_with(sample, 0.0);
}

}  // namespace gem
