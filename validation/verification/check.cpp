// Appends rows to the file named by the environment variable GEM_TABLE, if it is set. Tests may run in any order.
#include "validation/verification/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "gem/base/number_text.h"
#include "validation/verification/expected.h"

namespace gem::verification {
namespace {

struct Row {
  std::string key, engine, solver, expected, computed, error, tolerance, unit, verdict;
};

void enter(const Row& row) {
  const char* path = std::getenv("GEM_TABLE");
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::app);
  const std::string id = row.key.substr(0, row.key.find_first_not_of("0123456789", 1));
  file << id << ',' << row.key << ',' << row.engine << ',' << row.solver << ',' << row.expected << ',' << row.computed
       << ',' << row.error << ',' << row.tolerance << ',' << row.unit << ',' << row.verdict << '\n';
}

}  // namespace

void check_value(const std::string& key, double expected, double computed, double tolerance, const std::string& unit,
                 const Where& where) {
  const double error = std::fabs(computed - expected);
  const bool good = error <= tolerance;  // false if the computed value is NaN
  EXPECT_TRUE(good) << key << " on " << where.engine << " " << where.solver << ": expected " << number_text(expected)
                    << ", computed " << number_text(computed) << ", error " << number_text(error, 3) << ", tolerance "
                    << number_text(tolerance, 3) << " " << unit;
  enter({key, where.engine, where.solver, number_text(expected, 12), number_text(computed, 12), number_text(error, 3),
         number_text(tolerance, 3), unit, good ? "pass" : "FAIL"});
}

void check_absolute(const std::string& key, double computed, double tolerance, const Where& where) {
  const Expected& line = expected(key);
  check_value(key, line.value, computed, tolerance + line.last_digit, line.unit, where);
}

void check(const std::string& key, double computed, double relative_tolerance, const Where& where) {
  check_absolute(key, computed, relative_tolerance * std::fabs(value_of(key)), where);
}

void check_missed(const std::string& key, double bound, double computed, const std::string& unit, const Where& where) {
  const bool missed = computed > bound;
  EXPECT_TRUE(missed) << key << " on " << where.engine << " " << where.solver << ": stated as missed, but "
                      << number_text(computed) << " is within " << number_text(bound) << " " << unit;
  enter({key, where.engine, where.solver, "0", number_text(computed, 12), number_text(computed, 3),
         number_text(bound, 3), unit, missed ? "missed" : "FAIL"});
}

void not_offered(const std::string& key) {
  const Expected& line = expected(key);
  enter({key, "-", "-", number_text(line.value, 12), "", "", "", line.unit, "not offered"});
}

}  // namespace gem::verification
