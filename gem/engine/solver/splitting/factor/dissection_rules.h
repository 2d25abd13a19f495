// What both forms of nested dissection and of the factor have in common: strips, what a cut costs, the order of sums.
#pragma once

#include <cmath>
#include <cstdint>

#include "gem/base/macros.h"

namespace gem {

/// Parts of so many bodies are not cut. Smaller ones give more and smaller nodes, larger ones fill more blocks of the
/// factor with zeros.
constexpr std::int32_t largest_leaf = 6;

/// Bodies of a part of a chunk, of which a product adds four (FrontFactor): on a device a thread takes a part.
constexpr std::int32_t part_bodies = 2, chunk_bodies = 4 * part_bodies;

/// Strips of equal width across a part.
struct CutStrips {
  static constexpr std::int32_t bins = 64;
  double least = 0.0, most = 0.0;

  GEM_HD std::int32_t bin_of(double at) const {
    const double scale = most - least > 1e-300 ? bins / (most - least) : 0.0;  // a smaller width has no finite inverse
    const auto bin = static_cast<std::int32_t>((at - least) * scale);
    return bin < bins - 1 ? bin : bins - 1;
  }
};

/// Calls take(bin, separator below, balanced, cost) for all cuts of a part of `n` bodies across an axis, in the order
/// in which the first of equal ones is the best. `count`: bodies of each bin. `change_below`, `change_above`: how the
/// separators below and above the cut change from one bin to the next.
template <class Take>
GEM_HD inline void each_cut(const std::int32_t* count, const std::int32_t* change_below,
                            const std::int32_t* change_above, std::int32_t n, Take&& take) {
  std::int32_t below = 0, separator_below = 0, separator_above = 0;
  for (std::int32_t bin = 1; bin < CutStrips::bins; ++bin) {
    below += count[bin - 1];
    separator_below += change_below[bin];
    separator_above += change_above[bin];
    const bool balanced =
        10 * std::int64_t{below} >= 3 * std::int64_t{n} && 10 * std::int64_t{below} <= 7 * std::int64_t{n};
    for (int k = 0; k < 2; ++k) {
      const bool from_below = k == 0;
      const std::int32_t separator = from_below ? separator_below : separator_above;
      const std::int32_t left = below - (from_below ? separator : 0), right = n - below - (from_below ? 0 : separator);
      if (left <= 0 || right <= 0) continue;
      const std::int32_t apart = left > right ? left - right : right - left;
      take(bin, from_below, balanced, separator * (1.0 + apart / static_cast<double>(n)));
    }
  }
}

}  // namespace gem
