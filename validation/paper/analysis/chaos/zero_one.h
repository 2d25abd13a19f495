// The 0-1 test for chaos, correlation version (Gottwald and Melbourne 2009): 0 for regular motion, 1 for chaos.
//
// It cannot distinguish chaos from noise, so compare with records of a null model. A finely sampled record looks
// regular: first thin it out to about four samples per period, and keep some thousand samples.
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

/// The test at `frequencies` random frequencies. Throws std::invalid_argument for fewer than 100 samples or a constant
/// record.
ZeroOne zero_one_test(std::span<const double> signal, std::size_t frequencies = 100, std::uint64_t seed = 1);

/// Every n-th sample, starting with the first.
std::vector<double> every_nth(std::span<const double> signal, std::size_t n);

}  // namespace gem
