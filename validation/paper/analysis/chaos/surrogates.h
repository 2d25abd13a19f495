// Surrogate records: the same values and the same spectrum, but no other structure; and tests against them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gem {

/// Iterated amplitude-adjusted surrogate (Schreiber and Schmitz 1996): exactly the values of the record in another
/// order, and very nearly its spectrum. A jump from the end of the record to its beginning is in the spectrum too: cut
/// the record with end_matched() first. Needs 16 samples, otherwise std::invalid_argument.
std::vector<double> surrogate(std::span<const double> signal, std::uint64_t seed, std::size_t iterations = 200);

using SignalStatistic = std::function<double(std::span<const double>)>;

/// Where the record stands among its surrogates.
struct SurrogateTest {
  double observed = 0.0;
  std::vector<double> surrogates;
  double p_low = 1.0;   // chance of a value as small
  double p_high = 1.0;  // chance of a value as large

  double two_sided() const;
};

/// The stretch of `length` samples that best ends as it begins, in value and in slope. A length of small prime factors
/// (fourier.h) is quick to transform. Needs length + 2 samples, otherwise std::invalid_argument.
std::vector<double> end_matched(std::span<const double> signal, std::size_t length);

/// One record of the hypothesis that is tested, for each seed.
using SignalGenerator = std::function<std::vector<double>(std::uint64_t seed)>;

/// Ranks the record among `count` records of the generator, seeds `seed`, `seed` + 1, ... 39 records allow p = 0.05
/// two-sided, 19 one-sided.
SurrogateTest test_against(std::span<const double> signal, const SignalStatistic& statistic,
                           const SignalGenerator& generator, std::size_t count = 39, std::uint64_t seed = 1);

/// The same with surrogates of the record. The prediction error of a linear narrow-band record is found too small too
/// often, for its own spectrum is ragged where the process has one smooth peak. Of records of the null model over 128
/// periods, a test that should reject 3 of 60 rejects 15 at a damping ratio of 0.02, 3 when their ends match, but 38
/// and 19 at 0.005; time_reversal_asymmetry() rejects 0 to 2 of 60 in all these. So test the platform's motion against
/// records of the model (impulse_oscillator.h).
SurrogateTest surrogate_test(std::span<const double> signal, const SignalStatistic& statistic, std::size_t count = 39,
                             std::uint64_t seed = 1);

}  // namespace gem
