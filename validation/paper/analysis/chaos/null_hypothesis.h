// Does a record show more than a hypothesis explains? Its rank among records of the hypothesis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gem {

using SignalStatistic = std::function<double(std::span<const double>)>;

/// One record of the hypothesis that is tested, for each seed.
using SignalGenerator = std::function<std::vector<double>(std::uint64_t seed)>;

/// Where the record stands among those of the hypothesis.
struct NullTest {
  double observed = 0.0;
  std::vector<double> of_null;  // the statistic of each record of the hypothesis
  double p_low = 1.0;           // chance of a value as small
  double p_high = 1.0;          // chance of a value as large

  double two_sided() const;
};

/// Ranks the record among `count` records of the generator, seeds `seed`, `seed` + 1, ... 39 records allow p = 0.05
/// two-sided, 19 one-sided. The generator is a model of the motion (impulse_oscillator.h), not the record with its
/// phases shuffled: the spectrum of a linear narrow-band record is ragged where the process has one smooth peak, and
/// such surrogates were rejected up to 38 times in 60 where 3 are expected.
NullTest test_against(std::span<const double> signal, const SignalStatistic& statistic,
                      const SignalGenerator& generator, std::size_t count = 39, std::uint64_t seed = 1);

}  // namespace gem
