// Values as TOML text, by std::to_chars.
#include "gem/scene/number_text.h"

#include <array>
#include <charconv>

namespace gem {

std::string plain_number_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return std::string(buffer.data(), end);
}

std::string number_text(double value) {
  std::string text = plain_number_text(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";  // n: inf and nan
  return text;
}

std::string pair_text(Vec2 value) { return "[" + number_text(value.x) + ", " + number_text(value.y) + "]"; }

std::string outline_text(const std::vector<Vec2>& outline) {
  std::string text = "[";
  for (std::size_t i = 0; i < outline.size(); ++i) text += (i == 0 ? "" : ", ") + pair_text(outline[i]);
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
