// Rounding and units of displayed numbers.
#include "gem/report/display.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "gem/base/number_text.h"

namespace gem {
namespace {

std::string to_text(double value, std::chars_format format, int precision) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, precision).ptr;
  return {buffer, end};
}

Unit scaled(const std::string& name, double largest) {
  if (largest >= 2e6) return {"M" + name, 1e6};
  if (largest >= 2e3) return {"k" + name, 1e3};
  return {name, 1.0};
}

}  // namespace

std::string rounded_text(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size < 1e-4 || size >= 1e7) return to_text(value, std::chars_format::scientific, digits - 1);
  // The exponent after rounding: 99.97 with three digits is 100, not 100.0.
  const std::string rounded = to_text(value, std::chars_format::scientific, digits - 1);
  const std::size_t power = rounded.find('e') + 1;
  int exponent = 0;
  std::from_chars(rounded.data() + power + (rounded[power] == '+' ? 1 : 0), rounded.data() + rounded.size(), exponent);
  return to_text(value, std::chars_format::fixed, std::max(0, digits - 1 - exponent));
}

std::string decimal_text(double value, int decimals) {
  return std::isfinite(value) ? to_text(value, std::chars_format::fixed, decimals) : "-";
}

std::string exponent_text(double value) {
  if (!std::isfinite(value)) return "-";
  return value == 0.0 ? "0" : to_text(value, std::chars_format::scientific, 1);
}

Unit length_unit(double largest) { return largest >= 1.0 ? Unit{"m", 1.0} : Unit{"mm", 1e-3}; }
Unit force_unit(double largest) { return scaled("N", largest); }
Unit impulse_unit(double largest) { return scaled("N s", largest); }
Unit time_unit(double duration_s) { return duration_s >= 3600.0 ? Unit{"h", 3600.0} : Unit{"s", 1.0}; }

std::string time_text(double time_s) {
  const Unit unit = time_unit(time_s);
  return number_text(time_s / unit.size, 4) + " " + unit.name;
}

std::string with_unit(double value, const Unit& unit, int digits) {
  return rounded_text(value / unit.size, digits) + " " + unit.name;
}

}  // namespace gem
