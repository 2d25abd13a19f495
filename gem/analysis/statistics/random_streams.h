// Random number streams of the analysis: one per purpose, so that none overlap.
#pragma once

#include <cstdint>

#include "gem/base/random.h"

namespace gem {

enum class AnalysisStream : std::uint32_t {
  bootstrap = 1000,
  moving_blocks,
  impulse_times = 1004,
  impulse_sizes,
  zero_one,
  test_signal,
};

inline RandomSequence random_sequence(std::uint64_t seed, AnalysisStream stream, std::uint32_t item = 0) {
  return RandomSequence(Random(seed, static_cast<std::uint32_t>(stream), item));
}

}  // namespace gem
