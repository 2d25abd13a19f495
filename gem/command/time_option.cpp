// Reads a number and its unit.
#include "gem/command/time_option.h"

#include <charconv>
#include <cmath>
#include <map>

#include "gem/base/error.h"
#include "gem/record/output/output_path.h"

namespace gem {

double time_of_option(const std::string& flag, const std::string& text) {
  static const std::map<std::string, double> units = {{"", 1.0}, {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}};
  double number = 0.0;
  const char* last = text.data() + text.size();
  const auto [end, fault] = std::from_chars(text.data(), last, number);
  const auto unit = units.find(fault == std::errc() ? std::string(end, last) : "?");
  if (unit == units.end() || !std::isfinite(number) || number < 0.0)
    throw Error(ExitCode::usage, flag + " " + shown(text) +
                                     " is not a time (a number from 0 on, in s, or with its unit: s, min or h); write "
                                     "for example 1.3h");
  return number * unit->second;
}

}  // namespace gem
