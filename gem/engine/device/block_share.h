// Shares of a GPU for the scenes of a batch: blocks for each scene, and time steps for each launch.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gem {

/// Most blocks that help a scene of `bodies` bodies. More would only wait for each other, and each block needs a body
/// of its own.
inline int useful_blocks(std::size_t bodies) {
  // both chosen by hand; they affect only speed
  constexpr std::size_t bodies_worth_a_block = 24, most = 4096;
  return static_cast<int>(std::clamp<std::size_t>(bodies / bodies_worth_a_block, 1, most));
}

/// Blocks for each scene on a device that runs `device_blocks` blocks at a time. Each scene gets one block. The others
/// are shared in proportion to `work` (any unit), up to useful[k] blocks for scene k. The sum is at most
/// `device_blocks`, or one block for each scene if there are more scenes; blocks then take turns.
inline std::vector<int> share_blocks(const std::vector<double>& work, const std::vector<int>& useful,
                                     int device_blocks) {
  std::vector<int> blocks(work.size(), 1);
  std::vector<std::size_t> order(work.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // scenes that need less than their share come first and leave more to the others
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return useful[i] * work[j] < useful[j] * work[i]; });
  double left = std::accumulate(work.begin(), work.end(), 0.0);
  int rest = std::max(0, device_blocks - static_cast<int>(work.size()));
  for (const std::size_t k : order) {
    const double share = left > 0.0 ? std::min<double>(rest, rest * work[k] / left) : 0.0;
    const int more = std::min(useful[k] - 1, static_cast<int>(share));
    blocks[k] += more;
    rest -= more;
    left -= work[k];
  }
  return blocks;
}

/// Time steps of each scene in one launch, at most `most`, chosen so that all scenes end together. `ahead`: time steps
/// that a scene still has to make. `next`: how many of them it may make now.
inline std::vector<std::int64_t> share_steps(const std::vector<std::int64_t>& ahead,
                                             const std::vector<std::int64_t>& next, std::int64_t most) {
  const std::int64_t longest = std::max<std::int64_t>(1, *std::max_element(ahead.begin(), ahead.end()));
  std::vector<std::int64_t> steps;
  for (std::size_t k = 0; k < ahead.size(); ++k) {
    const std::int64_t share = std::max<std::int64_t>(1, (ahead[k] * most + longest - 1) / longest);
    steps.push_back(std::min({next[k], share, most}));
  }
  return steps;
}

}  // namespace gem
