// How the multiprocessors of a GPU are shared out among the scenes of a batch, in space and in time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gem {

/// The most blocks that a scene is given: more than one for so many bodies would only wait for each other, and every
/// block needs a body of its own.
inline int useful_blocks(std::size_t bodies) {
  constexpr std::size_t bodies_worth_a_block = 24, most = 4096;
  return static_cast<int>(std::clamp<std::size_t>(bodies / bodies_worth_a_block, 1, most));
}

/// Clusters of these many blocks stand side by side without a gap, the larger ones placed first, for each divides the
/// next.
constexpr std::array<int, 5> share_sizes = {1, 2, 4, 8, 16};
/// More are worth it only where each scene can have them.
constexpr int largest_share = share_sizes.back();
/// How many clusters of each size the device runs at the same time where there are no others.
using ClusterPlaces = std::array<int, share_sizes.size()>;

/// Whether as many clusters of each size run at the same time.
inline bool fit_together(const ClusterPlaces& clusters, const ClusterPlaces& shared_memory) {
  for (std::size_t size = 0; size < share_sizes.size(); ++size) {
    int taken = 0;
    for (std::size_t larger = size; larger < share_sizes.size(); ++larger)
      taken += clusters[larger] * (share_sizes[larger] / share_sizes[size]);
    if (taken > shared_memory[size]) return false;
  }
  return true;
}

/// Blocks of each scene, `equal` if all have as many. `work` is what each has ahead, time times blocks in any unit.
/// Scenes that take longest get more, until the device is full; where there are too many scenes for that, all have as
/// many. No scene gets more than is useful for it.
inline std::vector<int> share_blocks(const std::vector<double>& work, const std::vector<int>& useful,
                                     const ClusterPlaces& shared_memory, int equal) {
  ClusterPlaces clusters{};
  clusters[0] = static_cast<int>(work.size());
  if (!fit_together(clusters, shared_memory)) return std::vector<int>(work.size(), equal);
  std::vector<std::size_t> size(work.size(), 0);
  std::vector<bool> grows(work.size(), true);
  const auto time = [&](std::size_t k) { return work[k] / share_sizes[size[k]]; };
  for (;;) {
    std::size_t longest = work.size();
    for (std::size_t k = 0; k < work.size(); ++k)
      if (grows[k] && (longest == work.size() || time(k) > time(longest))) longest = k;
    if (longest == work.size()) break;
    const std::size_t next = size[longest] + 1;
    ClusterPlaces grown = clusters;
    if (next < share_sizes.size()) --grown[next - 1], ++grown[next];
    if (next == share_sizes.size() || share_sizes[next] > useful[longest] || !fit_together(grown, shared_memory)) {
      grows[longest] = false;
      continue;
    }
    clusters = grown;
    size[longest] = next;
  }
  std::vector<int> blocks;
  for (const std::size_t chosen : size) blocks.push_back(share_sizes[chosen]);
  return blocks;
}

/// Time steps of each scene in one launch, so that all end at about the same time: the quickest makes `most`, a slower
/// one fewer, none fewer than `fewest`. `time` is that of a time step of each, in any unit.
inline std::vector<std::int64_t> share_steps(const std::vector<double>& time, std::int64_t fewest, std::int64_t most) {
  double quickest = std::numeric_limits<double>::infinity(), slowest = 0.0;
  for (const double one : time) {
    quickest = std::min(quickest, one);
    slowest = std::max(slowest, one);
  }
  const double all = std::max(static_cast<double>(most) * quickest, static_cast<double>(fewest) * slowest);
  std::vector<std::int64_t> steps;
  for (const double one : time)
    steps.push_back(static_cast<std::int64_t>(std::min(static_cast<double>(most), all / one)));
  return steps;
}

}  // namespace gem
