// Names a contact point across time steps, for the warm start that EngineState holds.
#pragma once

#include <cstdint>

namespace gem {

/// Bits of a key for a body and for a corner. Keys ascend in (a, b, feature).
constexpr int body_bits = 26, feature_bits = 12;

constexpr std::uint64_t contact_key(std::int32_t a, std::int32_t b, std::int32_t feature) {
  return static_cast<std::uint64_t>(a) << (body_bits + feature_bits) | static_cast<std::uint64_t>(b) << feature_bits |
         static_cast<std::uint64_t>(feature);
}

// the parts of a key
constexpr std::int32_t body_a_of(std::uint64_t key) {
  return static_cast<std::int32_t>(key >> (body_bits + feature_bits));
}
constexpr std::int32_t body_b_of(std::uint64_t key) {
  return static_cast<std::int32_t>(key >> feature_bits) & ((1 << body_bits) - 1);
}
constexpr std::int32_t feature_of(std::uint64_t key) {
  return static_cast<std::int32_t>(key) & ((1 << feature_bits) - 1);
}

/// The key of a corner of compliant contacts; `of_second`: it is a corner of b, in a.
constexpr std::uint64_t corner_key(std::int32_t a, std::int32_t b, std::int32_t corner, bool of_second) {
  return contact_key(a, b, 2 * corner + (of_second ? 1 : 0));
}
constexpr std::int32_t corner_of(std::uint64_t key) { return feature_of(key) / 2; }
constexpr bool is_of_second(std::uint64_t key) { return feature_of(key) % 2 != 0; }

}  // namespace gem
