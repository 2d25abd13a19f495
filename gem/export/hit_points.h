// The hits of floes on the platform as points.
#pragma once

#include <string>
#include <vector>

#include "gem/export/poly_data.h"
#include "gem/record/run_file/run_file.h"

namespace gem {

/// The rows of /events. Empty if the run did not record them. Throws Error(file_system) if the file is damaged.
class HitPoints {
 public:
  explicit HitPoints(const RunFile& file);

  /// A point at the first touch of each hit that began after `from_s` and not after `to_s` [s].
  PolyData between(double from_s, double to_s) const;

 private:
  std::vector<double> times_;
  std::vector<Vec2> places_, normals_;
  std::vector<std::int32_t> floes_;
  std::vector<std::pair<std::string, std::vector<double>>> values_;
};

}  // namespace gem
