// A sum whose order depends only on the number of terms, so that every number of threads gives the same bits.
//
// Groups of 32 neighbours are added as a tree, at distances 2, 1, 16, 8 and 4; then the group sums are added in the
// same way. A GPU warp adds in this order with shuffles, a CPU with packs of four.
#pragma once

#include <cstddef>

#include "gem/base/macros.h"

namespace gem {

constexpr int sum_width = 32;

/// Sum of four neighbours, at distances 2 and 1.
GEM_HD inline double sum_of_four(const double* s) { return (s[0] + s[2]) + (s[1] + s[3]); }

/// Sum of eight sums of four, at distances 16, 8 and 4 of the terms.
GEM_HD inline double sum_of_eight(const double* b) {
  return ((b[0] + b[4]) + (b[2] + b[6])) + ((b[1] + b[5]) + (b[3] + b[7]));
}

/// Sum of `count` terms. Overwrites `terms`, whose length must reach the next multiple of 32.
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
