// Writes values as TOML text with std::to_chars.
#include "gem/scene/toml/toml_text.h"

#include <array>
#include <charconv>

namespace gem {

std::string plain_number_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return std::string(buffer.data(), end);
}

std::string toml_number_text(double value) {
  std::string text = plain_number_text(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";  // "n" is in inf and nan
  return text;
}

std::string pair_text(Vec2 value) {
  std::string text = "[";
  text += toml_number_text(value.x) + ", " + toml_number_text(value.y) + "]";
  return text;
}

std::string outline_text(const std::vector<Vec2>& outline) {
  std::string text = "[";
  for (const Vec2 corner : outline) {
    if (text.size() > 1) text += ", ";
    text += pair_text(corner);
  }
  return text + "]";
}

std::string rows_text(const std::vector<std::vector<double>>& rows) {
  std::string text = "[";
  for (const std::vector<double>& row : rows) {
    text += text.size() > 1 ? ", [" : "[";
    for (std::size_t k = 0; k < row.size(); ++k) text += (k > 0 ? ", " : "") + toml_number_text(row[k]);
    text += "]";
  }
  return text + "]";
}

std::string quoted_text(const std::string& text) {
  constexpr const char* hex = "0123456789ABCDEF";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (byte < 0x20 || byte == 0x7f)
      out += std::string("\\u00") + hex[byte >> 4] + hex[byte & 15];
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace gem
