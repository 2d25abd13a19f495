// Counter-based random numbers: number `index` of a stream is a pure function of seed, stream, item and index.
//
// Philox4x32 with 10 rounds, key = seed, counter = (index, item, stream). There is no state, so the order of the calls,
// the number of threads and other draws have no effect. Transforms use gem/base/strict_math.h, not the C library.
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "gem/base/strict_math.h"

namespace gem {

/// One stream of random numbers. `stream` is its purpose, `item` a floe or an attempt.
class Random {
 public:
  Random(std::uint64_t seed, std::uint32_t stream, std::uint32_t item = 0)
      : seed_(seed), stream_(stream), item_(item) {}

  /// 128 random bits as two words.
  std::array<std::uint64_t, 2> bits(std::uint64_t index) const {
    const r123::Philox4x32::ctr_type counter = {{low(index), high(index), item_, stream_}};
    const r123::Philox4x32::key_type key = {{low(seed_), high(seed_)}};
    const r123::Philox4x32::ctr_type out = r123::Philox4x32()(counter, key);
    return {join(out[0], out[1]), join(out[2], out[3])};
  }
  /// Uniform in (0, 1), without both ends.
  double uniform(std::uint64_t index) const { return to_uniform(bits(index)[0]); }
  /// Standard normal (Box and Muller).
  double normal(std::uint64_t index) const {
    const auto words = bits(index);
    const double distance = std::sqrt(-2.0 * strict::log(to_uniform(words[0])));
    return distance * strict::rotation_of_turns(to_uniform(words[1])).cosine;
  }

 private:
  static std::uint32_t low(std::uint64_t word) { return static_cast<std::uint32_t>(word); }
  static std::uint32_t high(std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); }
  static std::uint64_t join(std::uint32_t a, std::uint32_t b) { return a | static_cast<std::uint64_t>(b) << 32; }
  static double to_uniform(std::uint64_t word) { return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52; }

  std::uint64_t seed_;
  std::uint32_t stream_;
  std::uint32_t item_;
};

/// Reads a stream in order.
class RandomSequence {
 public:
  explicit RandomSequence(Random random) : random_(random) {}
  double uniform() { return random_.uniform(index_++); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double normal() { return random_.normal(index_++); }
  /// Whole number in [0, count).
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }

 private:
  Random random_;
  std::uint64_t index_ = 0;
};

}  // namespace gem
