// How the multiprocessors of a GPU are shared out among the scenes of a batch.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace gem {

/// More are worth it only where each scene can have them.
constexpr int largest_share = 8;

/// The most blocks that a scene is given: more than one for so many bodies would only wait for each other, and every
/// block needs a body of its own.
inline int useful_blocks(std::size_t bodies) {
  constexpr std::size_t bodies_worth_a_block = 24, most = 4096;
  return static_cast<int>(std::clamp<std::size_t>(bodies / bodies_worth_a_block, 1, most));
}

/// Blocks of each scene, `equal` if all have as many. `work` is what a moment of each took lately, time times blocks in
/// any unit. Scenes that take longest get more, until all are about equally long or the multiprocessors are used up;
/// where there are too many scenes for that, all have as many.
inline std::vector<int> share_blocks(const std::vector<double>& work, int multiprocessors, int equal) {
  constexpr int sizes[] = {2, 3, 4, 6, largest_share};
  // clusters of several sizes do not fill the device: with 0.97 some had to wait for others
  constexpr double usable = 0.9;
  const int most = static_cast<int>(usable * multiprocessors);
  int left = most - sizes[0] * static_cast<int>(work.size());
  if (left < static_cast<int>(work.size()) / 4) return std::vector<int>(work.size(), equal);
  std::vector<std::size_t> size(work.size(), 0);
  const auto time = [&](std::size_t k) { return work[k] / sizes[size[k]]; };
  for (;;) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < work.size(); ++k)
      if (time(k) > time(longest)) longest = k;
    if (size[longest] + 1 == std::size(sizes)) break;
    const int more = sizes[size[longest] + 1] - sizes[size[longest]];
    if (more > left) break;
    left -= more;
    ++size[longest];
  }
  std::vector<int> blocks;
  for (const std::size_t chosen : size) blocks.push_back(sizes[chosen]);
  return blocks;
}

}  // namespace gem
