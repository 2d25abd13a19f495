// A sum whose order depends on the number of terms alone, so that any number of threads gets the same bits.
//
// Thirty-two neighbours are added as a tree, by the distances 2, 1, 16, 8, 4; then their sums the same way. A warp of a
// graphics processor adds in this order by exchanging values, a processor with packs of four by adding packs.
#pragma once

#include <cstddef>

#include "gem/base/macros.h"

namespace gem {

constexpr int sum_width = 32;

/// Sum of four neighbours, distances 2 and 1.
GEM_HD inline double sum_of_four(const double* s) { return (s[0] + s[2]) + (s[1] + s[3]); }

/// Sum of eight sums of four, distances 16, 8 and 4 of the terms.
GEM_HD inline double sum_of_eight(const double* b) {
  return ((b[0] + b[4]) + (b[2] + b[6])) + ((b[1] + b[5]) + (b[3] + b[7]));
}

/// Sum of `count` terms. `terms` is used up: it must have room for the next multiple of 32.
inline double ordered_sum(double* terms, std::size_t count) {
  if (count == 0) return 0.0;
  do {
    const std::size_t groups = (count + sum_width - 1) / sum_width;
    for (std::size_t i = count; i < groups * sum_width; ++i) terms[i] = 0.0;
    for (std::size_t g = 0; g < groups; ++g) {
      double eight[8];
      for (int k = 0; k < 8; ++k) eight[k] = sum_of_four(terms + g * sum_width + 4 * k);
      terms[g] = sum_of_eight(eight);
    }
    count = groups;
  } while (count > 1);
  return terms[0];
}

}  // namespace gem
