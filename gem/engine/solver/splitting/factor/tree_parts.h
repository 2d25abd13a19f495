// Divides an elimination tree among threads: parts that do not touch each other, and a trunk above them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gem/engine/solver/splitting/factor/dissection.h"

namespace gem {

/// Nodes ascend in each part and in the trunk. Below a node of a part all nodes are of that part.
struct TreeParts {
  std::vector<std::vector<std::int32_t>> part;
  std::vector<std::int32_t> trunk;
  std::vector<std::int32_t> part_of;  // of each node: its part, or the number of parts for the trunk
};

/// `work` of each node, in any unit. One part: all nodes are of the trunk. The subtree with the most work is cut, again
/// and again, and of these divisions the one that takes the least time is kept.
void divide_tree(const EliminationTree& tree, std::span<const double> work, std::int32_t parts, TreeParts& result);

}  // namespace gem
