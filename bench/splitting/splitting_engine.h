// The cpu engine with its coupled impulses found by operator splitting instead. Only for the study of that method.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/splitting/split_iteration.h"
#include "gem/engine/cpu/cpu_engine.h"

namespace gem::bench {

/// One thread. The engine's own iterations run once and are thrown away; seconds() counts the splitting alone.
class SplittingEngine : public CpuEngine {
 public:
  /// `tolerance`: of the velocities [m/s].
  SplittingEngine(const SceneDef& scene, Bodies bodies, double tolerance, int iterations_maximum);

  std::string method() const override { return "coupled, by operator splitting"; }
  /// Processor time of the splitting so far [s].
  double seconds() const { return seconds_; }
  /// Most iterations of an island in each time step so far, and its error [m/s].
  const std::vector<IslandResult>& results() const { return results_; }
  EngineState save() override;
  void restore(const EngineState& state) override;

 protected:
  void before_contact_events() override;
  void after_contact_events() override;

 private:
  PointMemory memory_of(std::uint64_t key) const;
  void gather();
  void settle();

  double tolerance_;
  int iterations_maximum_;
  std::vector<Vec2> velocity_;  // before the events, of each body
  std::vector<double> spin_;
  std::vector<std::uint64_t> keys_, next_keys_;  // ascending
  std::vector<PointMemory> memory_, next_memory_;
  std::vector<PointGeometry<double>> geometry_;
  std::vector<std::int32_t> place_;  // of each body among the moving bodies with points
  std::vector<std::int32_t> moving_;
  SplitIteration iteration_;
  std::vector<IslandResult> results_;
  double seconds_ = 0.0;
};

}  // namespace gem::bench
