// Whole numbers as bytes of variable length: small numbers take one byte, and runs of zeros compress well.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace gem::view {

class ByteWriter {
 public:
  /// Seven bits a byte, the lowest first; the eighth bit says that more follow.
  void whole(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>(value | 0x80);
    bytes_ += static_cast<char>(value);
  }
  /// Signs go to the lowest bit: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
  void signed_whole(std::int64_t value) {
    whole((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// The entries in which two lists of flags of one length differ: their number, then the distance of each from the last.
template <class Flags>
void write_changes(ByteWriter& out, const Flags& before, const Flags& now) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < now.size(); ++i) count += before[i] != now[i];
  out.whole(count);
  std::size_t last = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (before[i] == now[i]) continue;
    out.whole(i - last);
    last = i;
  }
}

}  // namespace gem::view
