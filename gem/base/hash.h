// A 64-bit hash of numbers. The same values in the same order give the same hash on every machine.
#pragma once

#include <bit>
#include <cstdint>

namespace gem {

/// FNV-1a over the bytes of each number, low byte first. Add members, never whole structs, since padding is undefined.
class Hash {
 public:
  void add(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) value_ = (value_ ^ ((word >> shift) & 0xffU)) * 0x100000001b3U;
  }
  /// Hashes the bits of the number, so that -0 and 0 differ.
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace gem
