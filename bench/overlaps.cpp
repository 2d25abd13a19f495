#include "bench/overlaps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "gem/geometry/polygon.h"

namespace gem::bench {
namespace {

bool can_meet(const Bodies& b, std::size_t i, std::size_t j) {
  return b.inverse_mass[i] > 0.0 || b.inverse_mass[j] > 0.0;
}

/// Separations of all pairs closer than `near` [m], smallest first.
std::vector<double> near_separations(const Bodies& b) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < b.count(); ++i)
    if (b.active[i]) order.push_back(i);
  const auto left = [&](std::size_t i) { return b.position[i].x - b.radius[i]; };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return left(i) < left(j); });
  std::vector<double> separations;
  for (std::size_t p = 0; p < order.size(); ++p) {
    const std::size_t i = order[p];
    const double right = b.position[i].x + b.radius[i] + near;
    for (std::size_t q = p + 1; q < order.size() && left(order[q]) < right; ++q) {
      const std::size_t j = order[q];
      if (!can_meet(b, i, j) || length(b.position[i] - b.position[j]) > b.radius[i] + b.radius[j] + near) continue;
      const double apart = convex_separation(world_outline(b, i), world_outline(b, j));
      if (apart < near) separations.push_back(apart);
    }
  }
  std::sort(separations.begin(), separations.end());
  return separations;
}

}  // namespace

Overlaps overlaps_of(const Bodies& bodies) {
  const std::vector<double> separations = near_separations(bodies);
  Overlaps result;
  result.near_pairs = static_cast<std::int64_t>(separations.size());
  if (separations.empty()) return result;
  const auto apart = std::lower_bound(separations.begin(), separations.end(), 0.0);
  const double count = static_cast<double>(separations.size());
  result.overlapping_pairs = apart - separations.begin();
  result.maximum = std::max(0.0, -separations.front());
  result.quantile_999 = std::max(0.0, -separations[static_cast<std::size_t>(0.001 * count)]);
  result.mean = -std::accumulate(separations.begin(), apart, 0.0) / count;
  if (apart != separations.end())
    result.mean_gap = std::accumulate(apart, separations.end(), 0.0) / static_cast<double>(separations.end() - apart);
  return result;
}

}  // namespace gem::bench
