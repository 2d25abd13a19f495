// Values that TOML cannot read: a number with a unit behind it, and a text without quotes.
#pragma once

#include <string>
#include <string_view>

namespace gem {

/// "8.0 m", "20min"; not "1e5" or "0xff".
bool is_number_with_unit(std::string_view text);

/// What is wrong with such a value, for a message.
struct ValueFault {
  std::string problem;  ///< "problem (value, allowed); suggestion"; empty: no such value
  std::string text;     ///< what may stand there in quotes; empty: nothing
};

/// The first such value of a line "key = value". `key` is its full name, which may have choices.
ValueFault value_fault(const std::string& key, std::string_view line);

}  // namespace gem
