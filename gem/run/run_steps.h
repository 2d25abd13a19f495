// One run under way: what is recorded and checked between two moves of its engine, whoever moves it.
#pragma once

#include <chrono>
#include <exception>
#include <optional>

#include "gem/record/recorder.h"
#include "gem/run/run_scene.h"

namespace gem {

/// Scene, engine and options stay as they are while this lives.
class RunSteps {
 public:
  RunSteps(const SceneDef& scene, Engine& engine, const RunOptions& options);

  /// Starts the clock of the run.
  void begin();
  bool at_end() const { return engine_.step() >= last_step_; }
  /// Time steps up to the next frame, or to where progress and the disk are looked at: `most`.
  std::int64_t steps_ahead(std::int64_t most = 64) const;
  /// Time steps up to the end.
  std::int64_t steps_left() const { return last_step_ - engine_.step(); }
  /// Empties a log for the next time steps.
  void prepare(StepLog& log) const;
  /// Records and checks the time steps that the engine has made; `log` holds them. Throws like run_scene.
  void take(const StepLog& log);
  /// Records where the run stopped, if that is between two frames. Throws like run_scene.
  void last_frame();
  /// Closes the file in order; `stop_signal` 0: at the end of the run. After this the run is over, also if it throws.
  RunSummary finish(int stop_signal);
  /// Saves what there is and says in the file why the run ended.
  void fail(const std::exception& error);

 private:
  double time() const { return double(engine_.step()) * scene_.numerics.time_step_s; }
  void frame();
  void flush();
  void progress(const StepLog& log);

  const SceneDef& scene_;
  Engine& engine_;
  const RunOptions& options_;
  RunLog log_;
  Recorder recorder_;
  std::optional<RunWriter> writer_;
  RunSummary summary_;
  std::int64_t last_step_ = 0;
  std::int64_t frame_step_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point flushed_;
};

}  // namespace gem
