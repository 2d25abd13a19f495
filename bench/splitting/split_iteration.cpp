#include "bench/splitting/split_iteration.h"

#include <algorithm>

#include "gem/base/choose.h"

namespace gem::bench {

void SplitIteration::begin(std::int32_t bodies, std::int32_t points) {
  body_.resize(bodies);
  point_.resize(points);
}

std::int32_t SplitIteration::root_of(std::int32_t body) {
  while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
  return body;
}

/// Sorts bodies and points by island, islands by their first body.
void SplitIteration::find_islands() {
  const auto bodies = static_cast<std::int32_t>(body_.size());
  parent_.resize(bodies);
  for (std::int32_t i = 0; i < bodies; ++i) parent_[i] = i;
  for (const IslandPoint& p : point_) {
    if (p.a == fixed || p.b == fixed) continue;
    const std::int32_t a = root_of(p.a), b = root_of(p.b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  island_.resize(bodies);
  std::int32_t islands = 0;
  for (std::int32_t i = 0; i < bodies; ++i) {
    const std::int32_t root = root_of(i);
    island_[i] = root == i ? islands++ : island_[root];
  }
  const auto island_of = [this](const IslandPoint& p) { return island_[p.a == fixed ? p.b : p.a]; };
  first_body_.assign(islands + 1, 0);
  first_point_.assign(islands + 1, 0);
  for (std::int32_t i = 0; i < bodies; ++i) ++first_body_[island_[i] + 1];
  for (const IslandPoint& p : point_) ++first_point_[island_of(p) + 1];
  for (std::int32_t k = 0; k < islands; ++k) {
    first_body_[k + 1] += first_body_[k];
    first_point_[k + 1] += first_point_[k];
  }
  island_body_.resize(body_.size());
  island_point_.resize(point_.size());
  index_.resize(bodies);
  std::vector<std::int32_t>& next = parent_;
  next.assign(first_body_.begin(), first_body_.end());
  for (std::int32_t i = 0; i < bodies; ++i) {
    index_[i] = next[island_[i]] - first_body_[island_[i]];
    island_body_[next[island_[i]]++] = body_[i];
  }
  next.assign(first_point_.begin(), first_point_.end());
  for (IslandPoint p : point_) {
    const std::int32_t island = island_of(p);
    if (p.a != fixed) p.a = index_[p.a];
    if (p.b != fixed) p.b = index_[p.b];
    island_point_[next[island]++] = p;
  }
}

IslandResult SplitIteration::iterate(const IslandControl& control) {
  find_islands();
  IslandResult worst;
  for (std::size_t k = 0; k + 1 < first_body_.size(); ++k) {
    const std::int32_t body = first_body_[k], point = first_point_[k];
    const IslandResult result =
        solver_.solve({&island_body_[body], static_cast<std::size_t>(first_body_[k + 1] - body)},
                      {&island_point_[point], static_cast<std::size_t>(first_point_[k + 1] - point)}, control);
    worst.iterations = std::max(worst.iterations, result.iterations);
    worst.error = larger(worst.error, result.error);
  }
  return worst;
}

}  // namespace gem::bench
