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

}  // namespace gem::view
