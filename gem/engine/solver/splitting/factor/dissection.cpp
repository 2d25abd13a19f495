#include "gem/engine/solver/splitting/factor/dissection.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "gem/engine/solver/splitting/factor/dissection_rules.h"

namespace gem {
namespace {

double coordinate(Vec2 position, std::int32_t axis) { return axis == 0 ? position.x : position.y; }

}  // namespace

void Dissection::order(std::span<const Vec2> position, const ContactGraph& graph, EliminationTree& tree) {
  position_ = position;
  graph_ = &graph;
  tree_ = &tree;
  const auto n = static_cast<std::int32_t>(position.size());
  part_.assign(n, 0);
  parts_ = 0;
  bin_.resize(n);
  side_.resize(n);
  tree.node.clear();
  tree.order.resize(n);
  std::iota(tree.order.begin(), tree.order.end(), 0);
  if (n > 0) dissect(0, n);
}

void Dissection::set_bins(std::int32_t axis, std::int32_t begin, std::int32_t end) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::int32_t k = begin; k < end; ++k) {
    const double at = coordinate(position_[tree_->order[k]], axis);
    least = std::min(least, at);
    most = std::max(most, at);
  }
  const CutStrips strips{least, most};
  for (std::int32_t k = begin; k < end; ++k) {
    const std::int32_t body = tree_->order[k];
    bin_[body] = strips.bin_of(coordinate(position_[body], axis));
  }
}

/// Finds the cheapest cut of a part across an axis.
void Dissection::consider(std::int32_t axis, bool balanced, std::int32_t begin, std::int32_t end, Cut& best) {
  set_bins(axis, begin, end);
  const std::int32_t part = part_[tree_->order[begin]], n = end - begin;
  // bodies of each bin; and how the separators below and above the cut change from one bin to the next
  std::int32_t count[bins + 2] = {}, change_below[bins + 2] = {}, change_above[bins + 2] = {};
  for (std::int32_t k = begin; k < end; ++k) {
    const std::int32_t body = tree_->order[k], bin = bin_[body];
    std::int32_t farthest = bin, nearest = bin;
    for (std::int32_t e = graph_->first[body]; e < graph_->first[body + 1]; ++e) {
      const std::int32_t other = graph_->neighbour[e];
      if (part_[other] != part) continue;
      farthest = std::max(farthest, bin_[other]);
      nearest = std::min(nearest, bin_[other]);
    }
    ++count[bin];
    // a body is in the separator of all cuts between its own bin and that of its farthest neighbour
    ++change_below[bin + 1];
    --change_below[farthest + 1];
    ++change_above[nearest + 1];
    --change_above[bin + 1];
  }
  each_cut(count, change_below, change_above, n, [&](std::int32_t bin, bool below, bool in_balance, double cost) {
    if (balanced && !in_balance) return;
    if (best.axis < 0 || cost < best.cost) best = {axis, bin, below, cost};
  });
}

Dissection::Cut Dissection::best_cut(std::int32_t begin, std::int32_t end) {
  Cut best;
  for (const bool balanced : {true, false}) {
    for (const std::int32_t axis : {0, 1}) consider(axis, balanced, begin, end, best);
    if (best.axis >= 0) break;
  }
  return best;
}

/// Sorts the bodies of a part: below the cut, above it, separator.
void Dissection::divide(const Cut& cut, std::int32_t begin, std::int32_t end, std::int32_t& below,
                        std::int32_t& above) {
  set_bins(cut.axis, begin, end);
  std::vector<std::int32_t>& order = tree_->order;
  const std::int32_t part = part_[order[begin]];
  for (std::int32_t k = begin; k < end; ++k) {
    const std::int32_t body = order[k];
    const bool is_below = bin_[body] < cut.bin;
    side_[body] = is_below ? 0 : 1;
    if (is_below != cut.separator_below) continue;
    for (std::int32_t e = graph_->first[body]; e < graph_->first[body + 1]; ++e) {
      const std::int32_t other = graph_->neighbour[e];
      if (part_[other] == part && (bin_[other] < cut.bin) != is_below) side_[body] = 2;
    }
  }
  kept_.clear();
  for (std::int32_t side = 0; side < 3; ++side) {
    for (std::int32_t k = begin; k < end; ++k)
      if (side_[order[k]] == side) kept_.push_back(order[k]);
    if (side == 0) below = static_cast<std::int32_t>(kept_.size());
    if (side == 1) above = static_cast<std::int32_t>(kept_.size()) - below;
  }
  for (std::int32_t k = begin; k < end; ++k) {
    order[k] = kept_[k - begin];
    part_[order[k]] = parts_ + 1 + side_[order[k]];
  }
  parts_ += 3;
}

std::int32_t Dissection::close_node(std::int32_t begin, std::int32_t end) {
  tree_->node.push_back({begin, end, -1});
  return static_cast<std::int32_t>(tree_->node.size()) - 1;
}

/// Returns the node at the top of a part.
std::int32_t Dissection::dissect(std::int32_t begin, std::int32_t end) {
  const Cut cut = end - begin > largest_leaf ? best_cut(begin, end) : Cut{};
  if (cut.axis < 0) return close_node(begin, end);
  std::int32_t below = 0, above = 0;
  divide(cut, begin, end, below, above);
  const std::int32_t left = dissect(begin, begin + below);
  const std::int32_t right = dissect(begin + below, begin + below + above);
  const std::int32_t separator = close_node(begin + below + above, end);
  tree_->node[left].parent = separator;
  tree_->node[right].parent = separator;
  return separator;
}

}  // namespace gem
