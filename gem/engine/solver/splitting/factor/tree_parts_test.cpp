// Division of an elimination tree among threads.
#include "gem/engine/solver/splitting/factor/tree_parts.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace gem {
namespace {

/// A tree whose nodes have two children each, by levels from the top, in the order of elimination.
EliminationTree binary_tree(int levels) {
  EliminationTree tree;
  const auto grow = [&tree](auto&& self, int left) -> std::int32_t {
    std::vector<std::int32_t> children;
    for (int k = 0; left > 1 && k < 2; ++k) children.push_back(self(self, left - 1));
    const auto node = static_cast<std::int32_t>(tree.node.size());
    tree.node.push_back({node, node + 1, -1});
    for (const std::int32_t child : children) tree.node[child].parent = node;
    return node;
  };
  grow(grow, levels);
  return tree;
}

TEST(TreeParts, ShareTheWorkAndDoNotTouch) {
  const EliminationTree tree = binary_tree(8);
  const std::vector<double> work(tree.node.size(), 1.0);
  for (const std::int32_t parts : {2, 3, 4}) {
    TreeParts division;
    divide_tree(tree, work, parts, division);
    std::vector<int> seen(tree.node.size(), 0);
    for (const auto& nodes : division.part) {
      for (const std::int32_t k : nodes) ++seen[k];
      // a fair share and a quarter of it
      EXPECT_LE(4.0 * parts * static_cast<double>(nodes.size()), 5.0 * static_cast<double>(tree.node.size()));
    }
    for (const std::int32_t k : division.trunk) ++seen[k];
    EXPECT_EQ(seen, std::vector<int>(tree.node.size(), 1));
    for (std::size_t k = 0; k < tree.node.size(); ++k) {
      const std::int32_t parent = tree.node[k].parent, part = division.part_of[k];
      if (parent < 0) continue;
      EXPECT_TRUE(division.part_of[parent] == part || division.part_of[parent] == parts) << "node " << k;
    }
  }
}

TEST(TreeParts, OnePartIsTheTrunk) {
  const EliminationTree tree = binary_tree(4);
  const std::vector<double> work(tree.node.size(), 1.0);
  TreeParts division;
  divide_tree(tree, work, 1, division);
  std::vector<std::int32_t> all(tree.node.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(division.trunk, all);
}

}  // namespace
}  // namespace gem
