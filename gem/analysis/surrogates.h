// Surrogate records: the same values and the same spectrum, but no other structure; and tests against them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gem {

/// Iterated amplitude-adjusted surrogate (Schreiber and Schmitz 1996): exactly the values of the record in another
/// order, and very nearly its spectrum. Cut the record so that it ends as it began, at a fast length (fourier.h): a
/// jump from end to beginning is in the spectrum too. Needs 16 samples, otherwise std::invalid_argument.
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

/// One record of the hypothesis that is tested, for each seed.
using SignalGenerator = std::function<std::vector<double>(std::uint64_t seed)>;

/// Ranks the record among `count` records of the generator, seeds `seed`, `seed` + 1, ... 39 records allow p = 0.05
/// two-sided, 19 one-sided.
SurrogateTest test_against(std::span<const double> signal, const SignalStatistic& statistic,
                           const SignalGenerator& generator, std::size_t count = 39, std::uint64_t seed = 1);

/// The same with surrogates of the record. A narrow-band record of less than some hundred memory times is rejected far
/// too often even if it is linear, because its own spectrum is ragged where the process has one smooth peak: test the
/// platform's motion against records of a model (impulse_oscillator.h) instead.
SurrogateTest surrogate_test(std::span<const double> signal, const SignalStatistic& statistic, std::size_t count = 39,
                             std::uint64_t seed = 1);

}  // namespace gem
