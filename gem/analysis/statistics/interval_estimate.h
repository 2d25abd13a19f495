// A number and the interval that contains the true value with a stated confidence.
#pragma once

namespace gem {

struct IntervalEstimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;

  bool holds(double truth) const { return low <= truth && truth <= high; }
};

}  // namespace gem
