// Wilson's interval:  (p + z^2/2n  -+  z sqrt(p (1 - p) / n + z^2/4n^2)) / (1 + z^2/n).
#include "gem/analysis/statistics/proportion.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gem {

IntervalEstimate wilson_share(std::size_t successes, std::size_t trials, double confidence) {
  if (trials == 0 || successes > trials || !(confidence > 0.0 && confidence < 1.0))
    throw std::invalid_argument("a share needs a trial, no more successes than trials, and a confidence in (0, 1)");
  const double z = gsl_cdf_ugaussian_Pinv(0.5 + 0.5 * confidence);
  const auto n = static_cast<double>(trials);
  const double p = static_cast<double>(successes) / n;
  const double middle = p + z * z / (2.0 * n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  const double whole = 1.0 + z * z / n;
  // if all or none succeed, one end is 1 or 0 except for rounding
  return {p, std::max(0.0, (middle - half) / whole), std::min(1.0, (middle + half) / whole)};
}

}  // namespace gem
