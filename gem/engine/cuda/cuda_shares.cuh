// How the scenes of a batch share a GPU where blocks stay with them: how many blocks each has, and for how many
// moments.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "gem/engine/cuda/cuda_launch.cuh"
#include "gem/engine/device/block_share.h"

namespace gem {

class SceneShares {
  /// Of the slowest scene in one launch: fewer would not be worth the start.
  static constexpr std::int64_t fewest_moments = 16;

 public:
  /// `chosen_blocks` of each scene; 0: as help most.
  SceneShares(int threads, int chosen_blocks, int multiprocessors,
              const std::vector<BatchScene>& scenes)
      : threads_(threads),
        chosen_blocks_(chosen_blocks),
        multiprocessors_(multiprocessors),
        work_(scenes.size(), 0.0),
        share_(scenes.size(), 0) {
    for (const BatchScene& scene : scenes) {
      const std::size_t bodies = scene.bodies.count();
      useful_.push_back(chosen_blocks > 0 ? std::min(chosen_blocks, static_cast<int>(bodies)) : useful_blocks(bodies));
    }
  }

  /// Blocks of each scene where so many share the GPU.
  int blocks_for(std::size_t scenes) {
    if (chosen_blocks_ > 0) return chosen_blocks_;
    int& blocks = blocks_of_count_[scenes];
    const int useful = *std::max_element(useful_.begin(), useful_.end());
    if (blocks == 0) blocks = most_blocks(static_cast<int>(scenes), threads_, multiprocessors_, useful);
    return blocks;
  }

  bool are_chosen() const { return chosen_blocks_ > 0; }
  /// Blocks of scene k in the last launch.
  int of(std::size_t k) const { return share_[k]; }
  void set(std::size_t k, int blocks) { share_[k] = blocks; }
  /// That so many moments took scene k so many clocks of one block.
  void note(std::size_t k, double clocks, std::int64_t moments) {
    if (moments > 0 && clocks > 0.0) work_[k] = clocks * share_[k] / static_cast<double>(moments);
  }

  /// Shares the GPU out among some scenes, and lists these in the order of their blocks, most first.
  void share_out(std::vector<std::size_t>& active, const std::vector<MomentsAhead>& ahead) {
    guess_work(active);
    give_blocks(active, ahead);
    std::stable_sort(active.begin(), active.end(), [this](std::size_t i, std::size_t j) {
      return share_[i] != share_[j] ? share_[i] > share_[j] : work_[i] > work_[j];
    });
  }

  /// Moments of each for which all take about as long, `most` at most.
  std::vector<std::int64_t> moments_of(const std::vector<std::size_t>& active, const std::vector<MomentsAhead>& ahead,
                                       int most) const {
    std::vector<double> time;
    for (const std::size_t k : active) time.push_back(work_[k] / share_[k]);
    std::vector<std::int64_t> moments = share_moments(time, fewest_moments, most);
    for (std::size_t at = 0; at < active.size(); ++at) moments[at] = std::min(ahead[active[at]].most, moments[at]);
    return moments;
  }

 private:
  /// A scene that has made no moment yet is taken for one like the others.
  void guess_work(const std::vector<std::size_t>& active) {
    double sum = 0.0, known = 0.0;
    for (const std::size_t k : active) {
      sum += work_[k];
      known += work_[k] > 0.0 ? 1.0 : 0.0;
    }
    for (const std::size_t k : active)
      if (work_[k] == 0.0) work_[k] = known > 0.0 ? sum / known : 1.0;
  }

  /// As many blocks each where that fills the GPU better than clusters can, or where more would not help.
  void give_blocks(const std::vector<std::size_t>& active, const std::vector<MomentsAhead>& ahead) {
    const int equal = blocks_for(active.size());
    std::vector<double> work;
    std::vector<int> useful;
    for (const std::size_t k : active) {
      work.push_back(work_[k] * static_cast<double>(ahead[k].all));
      useful.push_back(useful_[k]);
    }
    const bool even =
        chosen_blocks_ > 0 || equal > largest_share || equal >= *std::max_element(useful.begin(), useful.end());
    const std::vector<int> blocks =
        even ? std::vector<int>(active.size(), equal) : share_blocks(work, useful, cluster_room(), equal);
    for (std::size_t at = 0; at < active.size(); ++at) share_[active[at]] = std::min(blocks[at], useful_[active[at]]);
  }

  const ClusterRoom& cluster_room() {
    if (cluster_room_[0] == 0) cluster_room_ = room_for_clusters(threads_);
    return cluster_room_;
  }

  int threads_, chosen_blocks_, multiprocessors_;
  std::map<std::size_t, int> blocks_of_count_;
  std::vector<int> useful_;     // most blocks of each scene
  ClusterRoom cluster_room_{};  // asked for when scenes first share the GPU
  std::vector<double> work_;    // of each scene: clocks of its blocks a moment, in the last launch; 0: unknown
  std::vector<int> share_;      // blocks of each in the last launch
};

}  // namespace gem
