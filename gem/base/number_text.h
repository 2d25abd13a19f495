// Numbers to text and back, independent of the locale.
#pragma once

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace gem {

/// Shortest text that reads back exactly, with a decimal point in any locale.
inline std::string number_text(double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

/// Shortest text with at most `digits` significant digits.
inline std::string number_text(double value, int digits) {
  std::array<char, 48> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits).ptr;
  return {buffer.data(), end};
}

/// Text with a fixed number of decimals, for people; values above 1e15 in exponent form.
inline std::string fixed_text(double value, int decimals) {
  std::array<char, 64> buffer;
  const bool huge = !(value < 1e15 && value > -1e15);
  const auto format = huge ? std::chars_format::scientific : std::chars_format::fixed;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, decimals).ptr};
}

/// The value of a text that is one whole decimal number; else nothing.
inline std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace gem
