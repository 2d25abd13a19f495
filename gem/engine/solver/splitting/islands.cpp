#include "gem/engine/solver/splitting/islands.h"

#include <algorithm>
#include <numeric>

#include "gem/base/choose.h"

namespace gem {
namespace {

/// Smaller islands are not worth a crew. Chosen by hand; affects only speed.
constexpr std::int32_t fewest_shared_points = 512;

}  // namespace

void Islands::begin(std::int32_t bodies, std::int32_t points, int threads) {
  body_.resize(bodies);
  point_.resize(points);
  if (static_cast<int>(solver_.size()) < threads) solver_.resize(threads);
  result_.assign(threads, {});
  crew_.begin(threads);
}

std::int32_t Islands::root_of(std::int32_t body) {
  while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
  return body;
}

/// Numbers islands by their first body. Returns how many there are.
std::int32_t Islands::number_islands() {
  const auto bodies = static_cast<std::int32_t>(body_.size());
  parent_.resize(bodies);
  std::iota(parent_.begin(), parent_.end(), 0);
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
  return islands;
}

void Islands::find() {
  const std::int32_t islands = number_islands();
  const auto bodies = static_cast<std::int32_t>(body_.size());
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
  // the largest first, so that no thread begins it last
  by_size_.resize(islands);
  std::iota(by_size_.begin(), by_size_.end(), 0);
  std::stable_sort(by_size_.begin(), by_size_.end(), [this](std::int32_t k, std::int32_t j) {
    return first_point_[k + 1] - first_point_[k] > first_point_[j + 1] - first_point_[j];
  });
  const auto points_of = [&](std::int32_t k) { return first_point_[by_size_[k] + 1] - first_point_[by_size_[k]]; };
  const auto fair_share = static_cast<std::int32_t>(point_.size() / result_.size());
  for (shared_ = 0; result_.size() > 1 && shared_ < islands; ++shared_)
    if (points_of(shared_) < std::max(fewest_shared_points, fair_share)) break;
  next_.store(shared_, std::memory_order_relaxed);
}

void Islands::solve_island(std::int32_t island, const IslandControl& control, int rank, IslandCrew& crew) {
  const std::int32_t k = by_size_[island], body = first_body_[k], point = first_point_[k];
  const IslandResult result = solver_[rank].solve(
      {island_body_.data() + body, static_cast<std::size_t>(first_body_[k + 1] - body)},
      {island_point_.data() + point, static_cast<std::size_t>(first_point_[k + 1] - point)}, control, crew);
  IslandResult& worst = result_[rank];
  worst.iterations = std::max(worst.iterations, result.iterations);
  worst.error = larger(worst.error, result.error);
}

void Islands::solve(const IslandControl& control, int rank) {
  if (rank == 0) {
    const CrewService service(crew_);
    for (std::int32_t k = 0; k < shared_; ++k) solve_island(k, control, rank, crew_);
  }
  for (;;) {
    const std::int32_t next = next_.fetch_add(1, std::memory_order_relaxed);
    if (next >= static_cast<std::int32_t>(by_size_.size())) break;
    solve_island(next, control, rank, alone_);
  }
  if (rank > 0) crew_.serve();
}

IslandResult Islands::worst() const {
  IslandResult worst;
  for (const IslandResult& one : result_) {
    worst.iterations = std::max(worst.iterations, one.iterations);
    worst.error = larger(worst.error, one.error);
  }
  return worst;
}

}  // namespace gem
