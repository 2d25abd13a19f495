#include "baseline_box2d/convex_pieces.h"

#include <algorithm>

namespace gem::baseline {

std::vector<std::vector<Vec2>> convex_pieces(const std::vector<Vec2>& outline, std::size_t corners_maximum) {
  std::vector<std::vector<Vec2>> pieces;
  std::vector<Vec2> rest = outline;
  // Each cut adds the two corners of its chord to the total.
  for (std::size_t left = (outline.size() - 2 + corners_maximum - 3) / (corners_maximum - 2); left > 1; --left) {
    const std::ptrdiff_t corners = static_cast<std::ptrdiff_t>((rest.size() + 2 * (left - 1) + left - 1) / left);
    pieces.emplace_back(rest.begin(), rest.begin() + corners);
    rest.erase(rest.begin() + 1, rest.begin() + corners - 1);
    // The next cut starts where this one ended, so that few corners are shared by several pieces.
    std::rotate(rest.begin(), rest.begin() + 1, rest.end());
  }
  pieces.push_back(rest);
  return pieces;
}

}  // namespace gem::baseline
