#include "bench/splitting/elimination_order.h"

#include <algorithm>
#include <cmath>

namespace gem::bench {

void EliminationOrder::order(std::span<const Vec2> position, const ContactGraph& graph,
                             std::vector<std::int32_t>& order) {
  position_ = position;
  graph_ = &graph;
  order_ = &order;
  const auto n = static_cast<std::int32_t>(position.size());
  rank_.assign(n, -1);
  side_.resize(n);
  for (int axis = 0; axis < 2; ++axis) {
    sorted_[axis].resize(n);
    for (std::int32_t k = 0; k < n; ++k) sorted_[axis][k] = k;
    std::sort(sorted_[axis].begin(), sorted_[axis].end(), [&](std::int32_t i, std::int32_t j) {
      const double p = axis == 0 ? position[i].x : position[i].y, q = axis == 0 ? position[j].x : position[j].y;
      return p < q || (p == q && i < j);
    });
  }
  dissect(0, n);
}

/// Finds the cheapest cut of the part [begin, end) across an axis.
void EliminationOrder::consider(std::int32_t axis, std::int32_t begin, std::int32_t end, Cut& best) {
  const std::vector<std::int32_t>& sorted = sorted_[axis];
  const std::int32_t n = end - begin;
  for (std::int32_t k = 0; k < n; ++k) rank_[sorted[begin + k]] = k;
  farthest_.resize(n);
  nearest_.resize(n);
  for (std::int32_t k = 0; k < n; ++k) {
    const std::int32_t body = sorted[begin + k];
    std::int32_t farthest = k, nearest = k;
    for (std::int32_t e = graph_->first[body]; e < graph_->first[body + 1]; ++e) {
      const std::int32_t other = rank_[graph_->neighbour[e]];
      if (other < 0) continue;
      farthest = std::max(farthest, other);
      nearest = std::min(nearest, other);
    }
    farthest_[k] = farthest;
    nearest_[k] = nearest;
  }
  for (const bool below : {true, false}) {
    // a body is in the separator of all cuts between its own rank and that of its farthest neighbour
    change_.assign(n + 2, 0);
    for (std::int32_t k = 0; k < n; ++k) {
      ++change_[below ? k + 1 : nearest_[k] + 1];
      --change_[below ? farthest_[k] + 1 : k + 1];
    }
    std::int32_t separator = 0;
    for (std::int32_t at = 0; at <= n; ++at) {
      separator += change_[at];
      if (10 * at < 3 * n || 10 * at > 7 * n) continue;
      const std::int32_t left = at - (below ? separator : 0), right = n - at - (below ? 0 : separator);
      if (left <= 0 || right <= 0) continue;
      const double cost = separator * (1.0 + std::abs(left - right) / static_cast<double>(n));
      if (best.axis < 0 || cost < best.cost) best = {axis, at, below, cost};
    }
  }
  for (std::int32_t k = 0; k < n; ++k) rank_[sorted[begin + k]] = -1;
}

/// Moves the bodies of [begin, end) in both sorted lists: below the cut, above it, separator.
void EliminationOrder::divide(const Cut& cut, std::int32_t begin, std::int32_t end, std::int32_t& below,
                              std::int32_t& above) {
  const std::vector<std::int32_t>& by = sorted_[cut.axis];
  const std::int32_t n = end - begin;
  for (std::int32_t k = 0; k < n; ++k) rank_[by[begin + k]] = k;
  for (std::int32_t k = 0; k < n; ++k) {
    const bool is_below = k < cut.at;
    std::int32_t side = is_below ? 0 : 1;
    if (is_below == cut.separator_below) {
      const std::int32_t body = by[begin + k];
      for (std::int32_t e = graph_->first[body]; e < graph_->first[body + 1]; ++e) {
        const std::int32_t other = rank_[graph_->neighbour[e]];
        if (other >= 0 && (other < cut.at) != is_below) side = 2;
      }
    }
    side_[by[begin + k]] = side;
  }
  for (std::int32_t k = 0; k < n; ++k) rank_[by[begin + k]] = -1;
  for (std::vector<std::int32_t>& sorted : sorted_) {
    kept_.clear();
    for (std::int32_t side = 0; side < 3; ++side) {
      for (std::int32_t k = begin; k < end; ++k)
        if (side_[sorted[k]] == side) kept_.push_back(sorted[k]);
      if (side == 0) below = static_cast<std::int32_t>(kept_.size());
      if (side == 1) above = static_cast<std::int32_t>(kept_.size()) - below;
    }
    std::copy(kept_.begin(), kept_.end(), sorted.begin() + begin);
  }
}

void EliminationOrder::dissect(std::int32_t begin, std::int32_t end) {
  constexpr std::int32_t leaf = 4;
  Cut cut;
  if (end - begin > leaf) {
    consider(0, begin, end, cut);
    consider(1, begin, end, cut);
  }
  if (cut.axis < 0) {
    order_->insert(order_->end(), sorted_[0].begin() + begin, sorted_[0].begin() + end);
    return;
  }
  std::int32_t below = 0, above = 0;
  divide(cut, begin, end, below, above);
  dissect(begin, begin + below);
  dissect(begin + below, begin + below + above);
  order_->insert(order_->end(), sorted_[0].begin() + begin + below + above, sorted_[0].begin() + end);
}

}  // namespace gem::bench
