// SHA-256 (FIPS 180-4), used as the fingerprint of a resolved case.
#pragma once

#include <string>
#include <string_view>

namespace gem {

/// SHA-256 of the bytes, as 64 lower-case hex digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace gem
