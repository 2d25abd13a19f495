// Packets through zlib.
#include "gem/view/pack/packet.h"

#include <zlib.h>

#include <cstdint>
#include <new>
#include <nlohmann/json.hpp>

namespace gem::view {

namespace {

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int level = 7;  // 8 and 9 take twice the time for a hundredth of the size
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                level) != Z_OK)
    throw std::bad_alloc();  // the buffer is large enough, so only memory can be missing
  out.resize(size);
  return out;
}

}  // namespace

std::string json_text(const nlohmann::ordered_json& object) {
  return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string packet(const nlohmann::ordered_json& description, const std::string& payload) {
  const std::string head = json_text(description);
  std::string out;
  for (int byte = 0; byte < 4; ++byte) out += static_cast<char>(head.size() >> (8 * byte));
  return out + head + deflated(payload);
}

std::string base64(const std::string& bytes) {
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

}  // namespace gem::view
