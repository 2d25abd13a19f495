// How the multiprocessors of a GPU are shared out among the scenes of a batch.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace gem {

/// More are worth it only where each scene can have them.
constexpr int largest_share = 8;

/// Blocks of each scene. `work` is what a moment of each took lately, time times blocks in any unit. Scenes that take
/// longest get more, until all are about equally long or the multiprocessors are used up. Where there are too many
/// scenes for that, each gets `worth` blocks, with which its points stand in fast memory, and scenes wait for each
/// other.
inline std::vector<int> share_blocks(const std::vector<double>& work, int multiprocessors) {
  constexpr int sizes[] = {2, 3, 4, 6, largest_share}, worth = 4;
  constexpr double usable = 0.97;  // clusters of several sizes do not fill the device to the last
  const int most = static_cast<int>(usable * multiprocessors);
  if (3 * static_cast<int>(work.size()) > most) return std::vector<int>(work.size(), worth);
  std::vector<std::size_t> size(work.size(), 0);
  int left = most - sizes[0] * static_cast<int>(work.size());
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
