// Goes over the text character by character, by the rules of UTF-8.
#include "gem/report/plain_text.h"

#include <cstdint>

namespace gem {
namespace {

constexpr std::size_t bytes_maximum = 2000;

/// Bytes of the character at `at`, and the character; 0 bytes if it is not UTF-8.
std::size_t character_at(const std::string& text, std::size_t at, std::uint32_t& character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  const std::size_t size = first < 0x80         ? 1
                           : (first >> 5) == 6  ? 2
                           : (first >> 4) == 14 ? 3
                           : (first >> 3) == 30 ? 4
                                                : 0;
  if (size == 0 || at + size > text.size()) return 0;
  character = size == 1 ? first : first & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) return 0;
    character = (character << 6) | (byte(at + i) & 0x3fU);
  }
  constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = character >= 0xd800 && character < 0xe000;
  return character < smallest[size] || character > 0x10ffff || surrogate ? 0 : size;
}

/// Control characters, line ends of Unicode, and marks that turn the direction of writing.
bool is_control(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

std::string plain_text(const std::string& text) {
  std::string plain;
  for (std::size_t at = 0; at < text.size();) {
    std::uint32_t character = 0;
    const std::size_t size = character_at(text, at, character);
    if (plain.size() + size > bytes_maximum) return plain + "...";
    if (size == 0)
      plain += '?';
    else if (is_control(character))
      plain += ' ';
    else
      plain.append(text, at, size);
    at += size == 0 ? 1 : size;
  }
  return plain;
}

}  // namespace gem
