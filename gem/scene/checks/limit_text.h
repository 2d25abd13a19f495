// Limits as text.
#pragma once

#include <cmath>
#include <string>

#include "gem/base/number_text.h"

namespace gem {

/// An upper limit with four digits, rounded down so that the printed number is allowed.
inline std::string limit_text(double limit) {
  const double unit = std::pow(10.0, std::floor(std::log10(limit)) - 3.0);
  return number_text(std::floor(limit / unit * (1.0 + 1e-12)) * unit, 4);
}

}  // namespace gem
