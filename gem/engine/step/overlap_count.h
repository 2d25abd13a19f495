// Histogram of overlap depths, for quantiles.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "gem/base/macros.h"

namespace gem {

/// Counts of positive values in classes of eight per octave, from 2^-40 to 2^8. Counts are integers, so the order of
/// counting does not matter.
struct OverlapCount {
  static constexpr int per_octave = 8;
  static constexpr int lowest_octave = -40;
  static constexpr int classes = 48 * per_octave;
  std::array<std::int64_t, classes> count{};

  /// Class of a value: its exponent and its three leading mantissa bits. Values beyond the ends go to the end classes.
  static constexpr int class_of(double value) { return class_of_bits(std::bit_cast<std::uint64_t>(value)); }
  GEM_HD static constexpr int class_of_bits(std::uint64_t value) {
    const std::int64_t bits = static_cast<std::int64_t>(value >> 49);
    const std::int64_t index = bits - ((1023 + lowest_octave) << 3);
    return static_cast<int>(index < 0 ? 0 : index >= classes ? classes - 1 : index);
  }

  void add(double value) { ++count[class_of(value)]; }

  OverlapCount& operator+=(const OverlapCount& other) {
    for (int i = 0; i < classes; ++i) count[i] += other.count[i];
    return *this;
  }

  std::int64_t total() const {
    std::int64_t sum = 0;
    for (const std::int64_t n : count) sum += n;
    return sum;
  }

  /// Upper edge of the class that reaches the fraction `share` of all values; 0 without values.
  double quantile(double share) const {
    const double wanted = share * static_cast<double>(total());
    std::int64_t sum = 0;
    for (int i = 0; i < classes; ++i) {
      sum += count[i];
      if (sum > 0 && static_cast<double>(sum) >= wanted) return upper_edge(i);
    }
    return 0.0;
  }

  static double upper_edge(int index) {
    return std::ldexp(1.0 + (index % per_octave + 1) / static_cast<double>(per_octave),
                      lowest_octave + index / per_octave);
  }
};

}  // namespace gem
