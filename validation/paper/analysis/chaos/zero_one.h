// The 0-1 test for chaos, correlation version (Gottwald and Melbourne 2009): 0 for regular motion, 1 for chaos.
//
// It cannot tell chaos from noise: pair it with records of a null model. A record sampled finely looks regular: thin it
// out to about one sample in a quarter of a period first, and have some thousand samples left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gem {

struct ZeroOne {
  double k = 0.0;                                     // median over frequencies
  double lower_quartile = 0.0, upper_quartile = 0.0;  // of the frequencies
};

/// The test at `frequencies` random frequencies. Needs 100 samples, not all alike, otherwise std::invalid_argument.
ZeroOne zero_one_test(std::span<const double> signal, std::size_t frequencies = 100, std::uint64_t seed = 1);

/// Every n-th sample, from the first.
std::vector<double> every_nth(std::span<const double> signal, std::size_t n);

}  // namespace gem
