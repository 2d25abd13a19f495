// Counts ranks.
#include "validation/paper/analysis/chaos/null_hypothesis.h"

#include <algorithm>

namespace gem {

double NullTest::two_sided() const { return std::min(1.0, 2.0 * std::min(p_low, p_high)); }

NullTest test_against(std::span<const double> signal, const SignalStatistic& statistic,
                      const SignalGenerator& generator, std::size_t count, std::uint64_t seed) {
  NullTest test;
  test.observed = statistic(signal);
  std::size_t as_small = 1;
  std::size_t as_large = 1;
  for (std::size_t i = 0; i < count; ++i) {
    test.of_null.push_back(statistic(generator(seed + i)));
    as_small += test.of_null.back() <= test.observed ? 1 : 0;
    as_large += test.of_null.back() >= test.observed ? 1 : 0;
  }
  test.p_low = static_cast<double>(as_small) / static_cast<double>(count + 1);
  test.p_high = static_cast<double>(as_large) / static_cast<double>(count + 1);
  return test;
}

}  // namespace gem
