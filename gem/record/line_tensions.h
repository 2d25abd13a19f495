// Keeps the largest tension of each mooring line between two samples, and when the lines broke.
#pragma once

#include <vector>

#include "gem/engine/engine.h"

namespace gem {

/// What a run carries of its lines from one time step to the next.
struct LineSums {
  std::vector<double> tension;     // at the fairlead, largest since the last sample [N]
  std::vector<double> break_time;  // 0: the line holds [s]
};

/// Whether the platform of the case hangs on lines.
bool has_lines(const SceneDef& scene);

/// Tensions follow from place and rotation of the platform, so no engine keeps them.
class LineTensions {
 public:
  /// Of a case without lines: nothing is kept.
  explicit LineTensions(const SceneDef& scene);

  std::size_t lines() const { return tables_.branch.size(); }
  /// Adds a time step that ends at `time` [s].
  void add(const PlatformStep& step, double time);
  /// Appends the tensions and the times to the rows of a file and starts anew with the tensions. A broken line has 0.
  void take(std::vector<double>& tension, std::vector<double>& break_time);
  const LineSums& sums() const { return sums_; }
  void restore(const LineSums& sums) { sums_ = sums; }

 private:
  MooringTables tables_;
  bool keeps_tensions_;
  LineSums sums_;
};

}  // namespace gem
