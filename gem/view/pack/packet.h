// What the page is given: a packet is a description in JSON and compressed numbers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace gem::view {

/// Length of the description (4 bytes, lowest first), the description, and `payload` as a zlib stream.
std::string packet(const nlohmann::ordered_json& description, const std::string& payload);

/// JSON on one line. Bytes that are not UTF-8 become replacement characters.
std::string json_text(const nlohmann::ordered_json& object);

}  // namespace gem::view
