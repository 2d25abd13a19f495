// Sums what the ice does to each side of the platform between two samples.
#pragma once

#include <vector>

#include "gem/engine/engine.h"

namespace gem {

/// Impulses on the sides of an outline since the last sample [N s]. Side k runs from corner k to corner k + 1.
struct SideSums {
  std::vector<double> normal;    // that presses on the side
  std::vector<double> friction;  // along the side, from corner k to corner k + 1
};

/// Every floe that presses in a time step counts, whether it hits or rests. Not more than one side takes a contact, see
/// side_of().
class SideLoads {
 public:
  /// `outline` is that of the platform, about its centre; empty: nothing is summed.
  explicit SideLoads(std::vector<Vec2> outline);
  /// The same of a platform of several pieces: their sides count on from piece to piece. Sides along joints get
  /// nothing.
  explicit SideLoads(std::vector<std::vector<Vec2>> pieces);

  std::size_t sides() const { return sums_.normal.size(); }
  /// Adds a row of the log of a time step; `place` and `rotation` of the platform are those of the end of the step.
  void add(const ContactEvent& row, Vec2 place, Rotation rotation);
  /// Appends the sums to the rows of a file and starts anew.
  void take(std::vector<float>& normal, std::vector<float>& friction);
  const SideSums& sums() const { return sums_; }
  void restore(const SideSums& sums) { sums_ = sums; }

 private:
  void clear();

  std::vector<std::vector<Vec2>> pieces_;
  std::vector<std::size_t> first_;  // side of each piece
  SideSums sums_;
};

}  // namespace gem
