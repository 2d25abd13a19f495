// Bytes as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace gem {

/// Base64 with the alphabet of RFC 4648 and padding.
inline std::string base64(const std::string& bytes) {
  constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k])) : 0U;
    };
    const std::uint32_t three = (byte(0) << 16) | (byte(1) << 8) | byte(2);
    out += alphabet[three >> 18];
    out += alphabet[(three >> 12) & 63];
    out += i + 1 < bytes.size() ? alphabet[(three >> 6) & 63] : '=';
    out += i + 2 < bytes.size() ? alphabet[three & 63] : '=';
  }
  return out;
}

}  // namespace gem
