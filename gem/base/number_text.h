// Numbers to text and back, the same under every locale.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace gem {

/// The shortest text that reads back as the same double.
inline std::string number_text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

/// With a fixed number of decimals, for people; values beyond 1e15 in exponent form.
inline std::string fixed_text(double value, int decimals) {
  char buffer[64];
  const bool huge = !(value < 1e15 && value > -1e15);
  const auto format = huge ? std::chars_format::scientific : std::chars_format::fixed;
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, format, decimals).ptr};
}

/// In exponent form, for people.
inline std::string scientific_text(double value, int decimals) {
  char buffer[64];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific, decimals).ptr};
}

/// A whole text as one decimal number; nothing if any character is left over.
inline std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace gem
