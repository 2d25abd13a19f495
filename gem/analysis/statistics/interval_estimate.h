// A number with the interval that holds the true one with a stated confidence.
#pragma once

namespace gem {

struct IntervalEstimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;

  bool holds(double truth) const { return low <= truth && truth <= high; }
};

}  // namespace gem
