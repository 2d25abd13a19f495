// Order in which the bodies of an island are eliminated: nested dissection by straight cuts.
//
// A cut at constant x or y divides the bodies in two halves; the bodies of one half that touch the other half form the
// separator, which is eliminated last. The halves are cut in the same way. Of all cuts that leave at least three tenths
// on each side the one with the smallest separator is taken, weighted by the balance. A contact graph is
// planar, so the factor has O(n log n) blocks (George 1973; Lipton, Rose and Tarjan 1979).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gem/base/vec2.h"

namespace gem::bench {

/// Neighbours of each body: those of body i are neighbour[first[i]] to neighbour[first[i + 1] - 1].
struct ContactGraph {
  std::vector<std::int32_t> first, neighbour;
};

class EliminationOrder {
 public:
  /// Appends all bodies to `order`, first eliminated first. `position`: of each body [m]. The result depends on
  /// positions and contacts only; of equal positions the lower body comes first.
  void order(std::span<const Vec2> position, const ContactGraph& graph, std::vector<std::int32_t>& order);

 private:
  struct Cut {
    std::int32_t axis = -1, at = 0;
    bool separator_below = false;
    double cost = 0.0;
  };

  void dissect(std::int32_t begin, std::int32_t end);
  void consider(std::int32_t axis, std::int32_t begin, std::int32_t end, Cut& best);
  void divide(const Cut& cut, std::int32_t begin, std::int32_t end, std::int32_t& below, std::int32_t& above);

  std::span<const Vec2> position_;
  const ContactGraph* graph_ = nullptr;
  std::vector<std::int32_t> sorted_[2];  // the island's bodies by x and by y; each part is a range of both
  std::vector<std::int32_t> rank_, farthest_, nearest_, change_, side_, kept_;
  std::vector<std::int32_t>* order_ = nullptr;
};

}  // namespace gem::bench
