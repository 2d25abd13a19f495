// Finds the number of floes of a concentration from the mean and the deviation of the size law.
#include "gem/field/generator/floe_count.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gem/base/error.h"
#include "gem/base/number_text.h"

namespace gem {
namespace {

constexpr double floes_maximum = 1e7;

double mean_area(const FloesDef& floes) {
  return floes.size_mean_m * floes.size_mean_m + floes.size_deviation_m * floes.size_deviation_m;
}

}  // namespace

std::int64_t count_of_concentration(const FloesDef& floes, double water) {
  const double count = floes.concentration * water / mean_area(floes);
  if (!(water > 0.0))
    throw Error(ExitCode::scene_rejected,
                "floes.concentration: no free water (obstacles take the whole field); move the field or the obstacles");
  if (count > floes_maximum)
    throw Error(ExitCode::scene_rejected, "floes.concentration: too many floes (" + number_text(count, 3) +
                                              " would be needed, allowed at most " + number_text(floes_maximum) +
                                              "); use larger floes or a smaller field");
  return std::max<std::int64_t>(1, std::llround(count));
}

double concentration_tolerance(const FloesDef& floes, double water) { return 0.5 * mean_area(floes) / water; }

}  // namespace gem
