// One run in progress: what is recorded and checked between two calls of its engine.
#pragma once

#include <chrono>
#include <exception>
#include <optional>

#include "gem/record/recorder.h"
#include "gem/run/checkpoint/checkpoint_keeper.h"
#include "gem/run/run_scene.h"
#include "gem/run/run_watch.h"

namespace gem {

/// Origin of the run file.
Provenance provenance_of(const SceneDef& scene, const Engine& engine, const RunOptions& options);

/// Scene, engine and options must outlive this object.
class RunSteps {
 public:
  RunSteps(const SceneDef& scene, Engine& engine, const RunOptions& options);

  /// Starts the wall clock of the run.
  void begin();
  bool at_end() const { return engine_.step() >= last_step_; }
  /// Time steps up to the next frame; at most `most`, so that progress and disk are checked often enough.
  std::int64_t steps_ahead(std::int64_t most = 64) const;
  /// Time steps up to the end of the run.
  std::int64_t steps_left() const { return last_step_ - engine_.step(); }
  /// Clears a log for the next time steps.
  void prepare(StepLog& log) const;
  /// Records and checks the time steps that the engine has done; `log` holds them. Throws like run_scene().
  void take(const StepLog& log);
  /// Records the last state if it lies between two frames. A run that stops early leaves a checkpoint first: what goes
  /// on from there has no such rows. Throws like run_scene().
  void last_rows();
  /// Closes the file; `stop_signal` is 0 at the end of the run. The run is over even if this throws.
  RunSummary finish(int stop_signal);
  /// Saves what is available, and writes the reason of the failure to the file.
  void fail(const std::exception& error);

 private:
  double time() const { return double(engine_.step()) * scene_.numerics.time_step_s; }
  void begin_file();
  void go_on_from(const Checkpoint& checkpoint);
  void say_no_room(const StepLog& log);
  void frame();
  /// Gives the recorded rows to the writer. With `flush` it shows them to readers.
  void hand_over(bool flush);
  /// Takes the state for a checkpoint, which the writer's thread writes, and shows all rows to readers.
  void checkpoint();
  void tell_fault_of_checkpoints();
  void progress(const StepLog& log);

  const SceneDef& scene_;
  Engine& engine_;
  const RunOptions& options_;
  RunLog log_;
  Recorder recorder_;
  RunWatch watch_;
  CheckpointKeeper checkpoints_;  // outlives the writer, whose thread uses it
  std::optional<RunWriter> writer_;
  RunSummary summary_;
  std::int64_t case_steps_ = 0;  // of the whole case
  std::int64_t last_step_ = 0;   // of this run
  std::int64_t frame_step_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point flushed_;
  std::int64_t flushes_ = 0;
  bool said_no_room_ = false;  // for more pieces
  std::string case_sha256_;
};

}  // namespace gem
