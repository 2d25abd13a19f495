// Tests whether a record shows more than a hypothesis explains, by its rank among records of the hypothesis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gem {

using SignalStatistic = std::function<double(std::span<const double>)>;

/// Makes a record of the hypothesis from a seed.
using SignalGenerator = std::function<std::vector<double>(std::uint64_t seed)>;

/// Rank of the record among those of the hypothesis.
struct NullTest {
  double observed = 0.0;
  std::vector<double> of_null;  // the statistic of each record of the hypothesis
  double p_low = 1.0;           // probability of a value at most as large
  double p_high = 1.0;          // probability of a value at least as large

  double two_sided() const;
};

/// Ranks the record among `count` records of the generator with seeds `seed`, `seed` + 1, ... 39 records allow p = 0.05
/// two-sided, 19 one-sided. Use a model of the motion as generator (impulse_oscillator.h), not the record with shuffled
/// phases: the spectrum of a linear narrow-band record is ragged where the process has one smooth peak, and such
/// surrogates were rejected up to 38 times in 60 instead of 3.
NullTest test_against(std::span<const double> signal, const SignalStatistic& statistic,
                      const SignalGenerator& generator, std::size_t count = 39, std::uint64_t seed = 1);

}  // namespace gem
