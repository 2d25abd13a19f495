// Reads cases_analytic.csv once.
#include "validation/verification/expected.h"

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "gem/base/number_text.h"

namespace gem::verification {
namespace {

/// The file keeps up to 14 digits. A number with 12 or more digits counts as rounded.
constexpr int exact_digits_maximum = 11;

/// Half a unit of the last printed digit; 0 for a number short enough to be exact.
double half_last_digit(const std::string& text) {
  const std::size_t exponent_at = text.find_first_of("eE");
  const std::string mantissa = text.substr(0, exponent_at);
  const double exponent = exponent_at == std::string::npos ? 0.0 : parse_number(text.substr(exponent_at + 1)).value();
  int digits = 0, decimals = 0;
  bool after_point = false;
  for (const char c : mantissa) {
    if (c == '.') after_point = true;
    if (c < '0' || c > '9') continue;
    if (digits > 0 || c != '0') ++digits;
    if (after_point) ++decimals;
  }
  return digits > exact_digits_maximum ? 0.5 * std::pow(10.0, exponent - decimals) : 0.0;
}

std::map<std::string, Expected> read_file() {
  std::ifstream file(GEM_SOURCE_DIR "/validation/verification/cases_analytic.csv");
  std::map<std::string, Expected> lines;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string key, number, unit;
    std::getline(fields, key, ',');
    std::getline(fields, number, ',');
    std::getline(fields, unit, ',');
    lines[key] = {parse_number(number).value(), half_last_digit(number), unit};
  }
  return lines;
}

}  // namespace

const Expected& expected(const std::string& key) {
  static const std::map<std::string, Expected> lines = read_file();
  const auto line = lines.find(key);
  if (line == lines.end()) throw std::runtime_error("no key " + key + " in cases_analytic.csv");
  return line->second;
}

double value_of(const std::string& key) { return expected(key).value; }

}  // namespace gem::verification
