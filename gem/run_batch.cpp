// Blocks of moments up to the next frame of any scene.
#include "gem/run_batch.h"

#include <algorithm>
#include <memory>

#include "gem/run_signals.h"
#include "gem/run_steps.h"

namespace gem {
namespace {

class BatchRun {
 public:
  BatchRun(const std::vector<SceneDef>& scenes, EngineBatch& batch, const std::vector<RunOptions>& options)
      : batch_(batch), options_(options), logs_(scenes.size()), ends_(scenes.size()), runs_(scenes.size()) {
    for (std::size_t k = 0; k < scenes.size(); ++k)
      guarded(k, [&] { runs_[k] = std::make_unique<RunSteps>(scenes[k], batch.engine(k), options[k]); });
  }

  std::vector<BatchEnd> go() {
    const StopSignals signals;
    each([](RunSteps& run, std::size_t) { run.begin(); });
    int stop = 0;
    while (std::int64_t moments = moments_ahead()) {
      stop = stop_signal_of(options_.front());
      if (stop != 0) break;
      advance(moments);
      finish(0, [](const RunSteps& run) { return run.at_end(); });
    }
    finish(stop, [](const RunSteps&) { return true; });
    return ends_;
  }

 private:
  /// Does something for a scene; a fault ends that scene's run alone.
  template <class Action>
  void guarded(std::size_t k, Action action) {
    try {
      action();
    } catch (const std::exception& error) {
      fail(k, error);
    }
  }

  template <class Action>
  void each(Action action) {
    for (std::size_t k = 0; k < runs_.size(); ++k)
      if (runs_[k]) guarded(k, [&] { action(*runs_[k], k); });
  }

  /// Ends the runs of which over(run) is true.
  template <class Over>
  void finish(int stop, Over over) {
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      if (!runs_[k] || !over(*runs_[k])) continue;
      guarded(k, [&] { runs_[k]->last_frame(); });
      if (const auto run = std::move(runs_[k])) guarded(k, [&] { ends_[k].summary = run->finish(stop); });
    }
  }

  void fail(std::size_t k, const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    ends_[k].fault = known ? error.what() : std::string("unexpected (") + error.what() + ") please report this";
    ends_[k].code = known ? known->code() : ExitCode::resource_limit;
    if (runs_[k]) runs_[k]->fail(error);
    runs_[k].reset();
  }

  /// 0: every run is at its end or has failed.
  std::int64_t moments_ahead() const {
    std::int64_t least = 0;
    for (const auto& run : runs_)
      if (run && !run->at_end()) least = least == 0 ? run->moments_ahead() : std::min(least, run->moments_ahead());
    return least;
  }

  /// Moves on what is neither over nor failed.
  void advance(std::int64_t moments) {
    std::vector<std::int64_t> goal(batch_.size()), some(batch_.size(), 0);
    for (std::size_t k = 0; k < goal.size(); ++k) {
      if (!runs_[k]) continue;
      runs_[k]->prepare(logs_[k]);
      some[k] = runs_[k]->at_end() ? 0 : moments;
      goal[k] = batch_.engine(k).moment() + some[k];
    }
    try {
      batch_.advance(some, logs_);
    } catch (const Error& error) {
      const bool of_a_scene = error.code() == ExitCode::numerical_stop;
      for (std::size_t k = 0; k < goal.size(); ++k)
        if (runs_[k] && (!of_a_scene || batch_.engine(k).moment() < goal[k])) fail(k, error);
    }
    each([this](RunSteps& run, std::size_t k) { run.take(logs_[k]); });
  }

  EngineBatch& batch_;
  const std::vector<RunOptions>& options_;
  std::vector<MomentLog> logs_;
  std::vector<BatchEnd> ends_;
  std::vector<std::unique_ptr<RunSteps>> runs_;  // empty: over
};

}  // namespace

std::vector<BatchEnd> run_batch(const std::vector<SceneDef>& scenes, EngineBatch& batch,
                                const std::vector<RunOptions>& options) {
  return BatchRun(scenes, batch, options).go();
}

}  // namespace gem
