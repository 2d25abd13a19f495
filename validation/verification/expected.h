// The expected values of the closed-form cases, read by key from cases_analytic.csv, so that no value is typed twice.
#pragma once

#include <string>

namespace gem::verification {

/// One line of cases_analytic.csv.
struct Expected {
  double value = 0.0;
  double last_digit = 0.0;  // half a unit of the last printed digit if the value is rounded, else 0
  std::string unit;
};

/// The line of a key. Throws std::runtime_error for an unknown key.
const Expected& expected(const std::string& key);

/// The value of a key.
double value_of(const std::string& key);

}  // namespace gem::verification
