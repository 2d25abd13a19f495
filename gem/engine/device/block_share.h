// How a GPU is shared out among the scenes of a batch, in space and in time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gem {

/// The most blocks that a scene is given: more than one for so many bodies would only wait for each other, and every
/// block needs a body of its own.
inline int useful_blocks(std::size_t bodies) {
  // both chosen by hand; they affect only speed
  constexpr std::size_t bodies_worth_a_block = 24, most = 4096;
  return static_cast<int>(std::clamp<std::size_t>(bodies / bodies_worth_a_block, 1, most));
}

/// Blocks of each scene where the device runs `shared_memory` of them at a time: one for each, and of the others a
/// share as large as the scene's part in all `work` (in any unit), but no more than are useful for it. All scenes
/// together have no more than `shared_memory`; only where these are more than that, each has one block and they take
/// turns.
inline std::vector<int> share_blocks(const std::vector<double>& work, const std::vector<int>& useful,
                                     int shared_memory) {
  std::vector<int> blocks(work.size(), 1);
  std::vector<std::size_t> order(work.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // scenes that need less than their share come first and leave the others more
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return useful[i] * work[j] < useful[j] * work[i]; });
  double left = std::accumulate(work.begin(), work.end(), 0.0);
  int rest = std::max(0, shared_memory - static_cast<int>(work.size()));
  for (const std::size_t k : order) {
    const double share = left > 0.0 ? std::min<double>(rest, rest * work[k] / left) : 0.0;
    const int more = std::min(useful[k] - 1, static_cast<int>(share));
    blocks[k] += more;
    rest -= more;
    left -= work[k];
  }
  return blocks;
}

/// Time steps of each scene in one launch, `most` at most: all come to their ends together. `ahead` is how many each
/// has to make, `next` how many of them it may make now.
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
