// The launches of a call on the phases route, spread over streams.
#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "gem/engine/cuda/cuda_phase_stream.cuh"

namespace gem {
namespace {

/// The scenes of a call, spread over some streams.
class PhaseStreams {
 public:
  explicit PhaseStreams(int multiprocessors) : multiprocessors_(multiprocessors) {}

  /// Whether the device can run the clusters that iterate coupled scenes.
  bool can_solve() { return device_largest_cluster() > 0; }

  /// Starts a call between the beginning and the end of `call`. `work` says where the scenes are. Scenes of one solver
  /// stand together; among them, those with a similar number of time steps.
  void run(PhaseLaunch work, const std::vector<PhaseScene>& scenes, const Timeline& call) {
    const std::vector<std::size_t> bounds = shared_out(scenes);
    const std::size_t count = bounds.size() - 1;
    while (stream_.size() < count) stream_.push_back(std::make_unique<PhaseStream>(multiprocessors_));
    const std::vector<int> solve_blocks = solve_blocks_of(scenes);
    std::vector<std::int64_t> starts(count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto first = static_cast<std::ptrdiff_t>(bounds[k]), last = static_cast<std::ptrdiff_t>(bounds[k + 1]);
      PhaseLaunch part = work;
      part.scenes += first;
      part.steps += first;
      part.grid_barriers += first;
      part.list_barriers += first;
      part.solve_blocks =
          stream_[k]->steady_blocks(*std::max_element(solve_blocks.begin() + first, solve_blocks.begin() + last));
      const std::vector<PhaseScene> some(scenes.begin() + first, scenes.begin() + last);
      starts[k] = stream_[k]->begin(part, some, static_cast<int>(count), call);
    }
    launch_all(starts);
    for (std::size_t k = 0; k < count; ++k) stream_[k]->end(call);
  }

 private:
  static constexpr std::size_t most_streams = 8, coupled_streams = 40;

  /// Starts all time steps. A stream with fewer starts than others has them spread over the same time.
  void launch_all(const std::vector<std::int64_t>& starts) {
    const std::int64_t most = *std::max_element(starts.begin(), starts.end());
    for (std::size_t k = 0; k < starts.size(); ++k) stream_[k]->launch(call_begins);
    for (std::int64_t m = 0; m < most; ++m)
      for (std::size_t k = 0; k < starts.size(); ++k)
        if ((m + 1) * starts[k] / most > m * starts[k] / most) stream_[k]->start_steps();
    for (std::size_t k = 0; k < starts.size(); ++k) stream_[k]->launch(call_ends);
  }

  /// First scene of each stream, and the end of the last.
  std::vector<std::size_t> shared_out(const std::vector<PhaseScene>& scenes) const {
    std::vector<std::size_t> bounds;
    const std::size_t streams = streams_for(scenes);
    for (std::size_t k = 0; k < streams; ++k) bounds.push_back(scenes.size() * k / streams);
    for (std::size_t k = 1; k < scenes.size(); ++k)
      if (scenes[k].solver != scenes[k - 1].solver || scenes[k].splitting != scenes[k - 1].splitting)
        bounds.push_back(k);
    bounds.push_back(scenes.size());
    std::sort(bounds.begin(), bounds.end());
    bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
    return bounds;
  }

  /// The number of streams. It is bounded by how many times the blocks fill the device: otherwise each stream would
  /// have too little to do. Coupled scenes get more streams, because scenes in one stream wait for each other's
  /// iterations.
  std::size_t streams_for(const std::vector<PhaseScene>& scenes) const {
    int blocks = 0;
    for (const PhaseScene& scene : scenes) blocks += scene.blocks;
    const auto useful = static_cast<std::size_t>(std::max(1, blocks / multiprocessors_));
    return std::min(scenes.size(), any_coupled(scenes) ? coupled_streams : std::min(most_streams, useful));
  }

  static bool any_coupled(const std::vector<PhaseScene>& scenes) {
    return std::any_of(scenes.begin(), scenes.end(),
                       [](const PhaseScene& scene) { return scene.solver == ContactSolver::coupled; });
  }

  /// Blocks that iterate each scene. First as many as its points are worth. If that is more than the device can use,
  /// each scene gets a share in proportion to its remaining work, but enough that shared memory holds most of its
  /// points. Not all scenes iterate at the same time.
  std::vector<int> solve_blocks_of(const std::vector<PhaseScene>& scenes) {
    constexpr double for_one = 32 * 400,
                     for_full = 32 * 1250;  // visits per block and time step, at 32 iterations, which is usual
    constexpr double waiting = 1.5;  // blocks per multiprocessor that may wait, of scenes with more than one block
    std::vector<int> blocks(scenes.size(), 1);
    std::vector<double> work(scenes.size(), 0.0);
    int worthwhile = 0;
    for (std::size_t k = 0; k < scenes.size(); ++k) {
      if (scenes[k].solver != ContactSolver::coupled) continue;
      worthwhile += blocks[k] = worthwhile_blocks(scenes[k].visits / for_one);
      work[k] = std::max(scenes[k].visits, for_one) * scenes[k].steps;
    }
    if (worthwhile <= waiting * multiprocessors_) return blocks;
    const double all = std::accumulate(work.begin(), work.end(), 0.0);
    for (std::size_t k = 0; k < scenes.size(); ++k) {
      const int least = std::clamp(static_cast<int>(scenes[k].visits / for_full + 0.5), 1, blocks[k]);
      blocks[k] = std::clamp(static_cast<int>(waiting * multiprocessors_ * work[k] / all), least, blocks[k]);
    }
    return blocks;
  }

  /// The smallest power of two above `blocks`, at most the largest cluster. The largest cluster if `blocks` is 0:
  /// nothing is known yet.
  int worthwhile_blocks(double blocks) {
    int some = device_largest_cluster();
    while (blocks > 0.0 && some > 1 && 2.0 * blocks < some) some /= 2;
    return some;
  }

  int device_largest_cluster() {
    if (largest_cluster_ < 0) largest_cluster_ = largest_solver();
    return largest_cluster_;
  }

  int multiprocessors_;
  int largest_cluster_ = -1;  // set when coupled scenes first take the phases route
  std::vector<std::unique_ptr<PhaseStream>> stream_;
};

}  // namespace
}  // namespace gem
