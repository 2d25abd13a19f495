#include "gem/engine/solver/splitting/factor/tree_parts.h"

#include <algorithm>
#include <utility>

namespace gem {
namespace {

/// Subtrees by the node at their top, the one with the most work first.
using Subtrees = std::vector<std::pair<double, std::int32_t>>;

void sort(Subtrees& subtrees) {
  std::sort(subtrees.begin(), subtrees.end(),
            [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
}

/// Gives each subtree, the largest first, to the part that has least. Returns the most work of a part.
double deal(const Subtrees& subtrees, std::int32_t parts, std::vector<std::int32_t>& part_of_subtree) {
  std::vector<double> load(parts, 0.0);
  part_of_subtree.resize(subtrees.size());
  for (std::size_t k = 0; k < subtrees.size(); ++k) {
    const auto least = std::min_element(load.begin(), load.end());
    *least += subtrees[k].first;
    part_of_subtree[k] = static_cast<std::int32_t>(least - load.begin());
  }
  return *std::max_element(load.begin(), load.end());
}

}  // namespace

void divide_tree(const EliminationTree& tree, std::span<const double> work, std::int32_t parts, TreeParts& result) {
  const auto nodes = static_cast<std::int32_t>(tree.node.size());
  result.part.assign(parts, {});
  result.trunk.clear();
  result.part_of.assign(nodes, parts);
  if (parts > 1 && nodes > 0) {
    std::vector<double> below(work.begin(), work.end());
    std::vector<std::vector<std::int32_t>> children(nodes);
    Subtrees now, best;
    for (std::int32_t k = 0; k < nodes; ++k) {
      const std::int32_t parent = tree.node[k].parent;
      if (parent < 0) {
        now.emplace_back(below[k], k);
      } else {
        below[parent] += below[k];
        children[parent].push_back(k);
      }
    }
    std::vector<std::int32_t> dealt, best_dealt;
    double trunk = 0.0, best_time = 0.0;
    const std::size_t most_subtrees = 8 * static_cast<std::size_t>(parts);
    for (bool first = true; !now.empty() && now.size() <= most_subtrees; first = false) {
      sort(now);
      const double time = trunk + deal(now, parts, dealt);
      if (first || time < best_time) {
        best_time = time;
        best = now;
        best_dealt = dealt;
      }
      const std::int32_t top = now.front().second;
      if (children[top].empty()) break;
      trunk += work[top];
      now.erase(now.begin());
      for (const std::int32_t child : children[top]) now.emplace_back(below[child], child);
    }
    for (std::size_t k = 0; k < best.size(); ++k) result.part_of[best[k].second] = best_dealt[k];
    for (std::int32_t k = nodes - 1; k >= 0; --k) {
      const std::int32_t parent = tree.node[k].parent;
      if (parent >= 0 && result.part_of[parent] < parts) result.part_of[k] = result.part_of[parent];
    }
  }
  for (std::int32_t k = 0; k < nodes; ++k) {
    const std::int32_t part = result.part_of[k];
    (part < parts ? result.part[part] : result.trunk).push_back(k);
  }
}

}  // namespace gem
