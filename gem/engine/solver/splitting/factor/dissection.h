// Order in which the bodies of an island are eliminated: nested dissection by straight cuts.
//
// A cut at constant x or y divides a part in two halves. The bodies of one half that touch the other half form the
// separator, which is eliminated after both halves; the halves are cut in the same way. Cuts stand at the borders of
// `bins` strips of equal width. Of those that leave at least three tenths of the bodies on each side the one with the
// smallest separator is taken, weighted by the balance. A contact graph is nearly planar, so the factor of n bodies has
// O(n log n) blocks (George 1973; Lipton, Rose and Tarjan 1979).
//
// All counts are whole numbers, so they may be summed in any order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/engine/solver/splitting/factor/dissection_rules.h"

namespace gem {

/// Neighbours of each body: those of body i are neighbour[first[i]] to neighbour[first[i + 1] - 1].
struct ContactGraph {
  std::vector<std::int32_t> first, neighbour;
};

/// A part that is not cut any more, or a separator.
struct EliminationNode {
  std::int32_t begin = 0, end = 0;  // its bodies: a range of the order
  std::int32_t parent = -1;         // the separator around it, -1: none
};

/// The tree of an island. Nodes and bodies come in the order of elimination: a node after all nodes below it.
struct EliminationTree {
  std::vector<EliminationNode> node;
  std::vector<std::int32_t> order;  // bodies
};

class Dissection {
 public:
  /// `position`: of each body [m]. The result depends on positions and contacts only. Bodies of a node ascend.
  void order(std::span<const Vec2> position, const ContactGraph& graph, EliminationTree& tree);

 private:
  static constexpr std::int32_t bins = CutStrips::bins;

  struct Cut {
    std::int32_t axis = -1, bin = 0;  // the half below holds the bins below `bin`
    bool separator_below = false;
    double cost = 0.0;
  };

  std::int32_t dissect(std::int32_t begin, std::int32_t end);
  std::int32_t close_node(std::int32_t begin, std::int32_t end);
  void set_bins(std::int32_t axis, std::int32_t begin, std::int32_t end);
  void consider(std::int32_t axis, bool balanced, std::int32_t begin, std::int32_t end, Cut& best);
  Cut best_cut(std::int32_t begin, std::int32_t end);
  void divide(const Cut& cut, std::int32_t begin, std::int32_t end, std::int32_t& below, std::int32_t& above);

  std::span<const Vec2> position_;
  const ContactGraph* graph_ = nullptr;
  EliminationTree* tree_ = nullptr;
  std::vector<std::int32_t> part_;  // of each body: number of the part that it belongs to now
  std::vector<std::int32_t> bin_, side_, kept_;
  std::int32_t parts_ = 0;
};

}  // namespace gem
