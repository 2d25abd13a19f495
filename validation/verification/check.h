// Compares a computed number with its closed form and enters it as a row of the results table.
#pragma once

#include <string>

namespace gem::verification {

/// Where a number was computed.
struct Where {
  std::string engine = "law";
  std::string solver = "-";
};

/// Rounding of a closed form in double: a few hundred operations of 1.1e-16 each (class E of the cases).
constexpr double rounding = 1e-12;

/// Compares with the expected value of `key`, with a relative tolerance plus half a unit of the file's last printed
/// digit.
void check(const std::string& key, double computed, double relative_tolerance, const Where& where = {});

/// Compares with an absolute tolerance in the unit of the key.
void check_absolute(const std::string& key, double computed, double tolerance, const Where& where = {});

/// Compares with a value that is not in the file (a zero, a ratio, a count). `key` starts with the case's id.
void check_value(const std::string& key, double expected, double computed, double tolerance, const std::string& unit,
                 const Where& where = {});

/// A bound on `computed` that is known to be missed. Fails if the bound is met, so that the known misses stay true.
void check_missed(const std::string& key, double bound, double computed, const std::string& unit, const Where& where);

/// Enters a row with the closed form of something that this program does not offer.
void not_offered(const std::string& key);

}  // namespace gem::verification
