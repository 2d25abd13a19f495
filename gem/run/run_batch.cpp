// Runs scenes side by side. Each advances to its own next frame, or as far as the engine takes it in one call.
#include "gem/run/run_batch.h"

#include <algorithm>
#include <memory>

#include "gem/engine/cpu/thread_team.h"
#include "gem/run/crash_message.h"
#include "gem/run/run_signals.h"
#include "gem/run/run_steps.h"

namespace gem {
namespace {

class BatchRun {
 public:
  BatchRun(const std::vector<SceneDef>& scenes, EngineBatch& batch, const std::vector<RunOptions>& options,
           int recorders)
      : batch_(batch),
        options_(options),
        logs_(scenes.size()),
        ends_(scenes.size()),
        runs_(scenes.size()),
        team_(std::clamp(recorders, 1, std::max(1, static_cast<int>(scenes.size())))) {
    for (std::size_t k = 0; k < scenes.size(); ++k)
      guarded(k, [&] { runs_[k] = std::make_unique<RunSteps>(scenes[k], batch.engine(k), options[k]); });
  }

  std::vector<BatchEnd> go() {
    const StopSignals signals;
    each([](RunSteps& run, std::size_t) { run.begin(); });
    int stop = 0;
    finish(0, [](const RunSteps& run) { return run.at_end(); });
    while (std::any_of(runs_.begin(), runs_.end(), [](const auto& run) { return run != nullptr; })) {
      stop = stop_signal_of(options_.front());
      if (stop != 0) break;
      advance();
      finish(0, [](const RunSteps& run) { return run.at_end(); });
    }
    finish(stop, [](const RunSteps&) { return true; });
    return ends_;
  }

 private:
  /// Runs work for one scene. A failure ends the run of that scene only.
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

  /// Ends the runs for which over(run) is true.
  template <class Over>
  void finish(int stop, Over over) {
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      if (!runs_[k] || !over(*runs_[k])) continue;
      guarded(k, [&] { runs_[k]->last_rows(); });
      if (const auto run = std::move(runs_[k])) guarded(k, [&] { ends_[k].summary = run->finish(stop); });
    }
  }

  void fail(std::size_t k, const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    ends_[k].fault = known ? error.what() : std::string("unexpected (") + error.what() + "); please report this";
    ends_[k].code = known ? known->code() : ExitCode::resource_limit;
    if (runs_[k]) runs_[k]->fail(error);
    runs_[k].reset();
  }

  /// Advances the scenes that still run. Progress, disk and signals are checked in between.
  void advance() {
    std::vector<StepsAhead> ahead(batch_.size());
    for (std::size_t k = 0; k < ahead.size(); ++k) {
      if (!runs_[k]) continue;
      runs_[k]->prepare(logs_[k]);
      ahead[k] = {runs_[k]->steps_ahead(most_launch_steps), runs_[k]->steps_left()};
    }
    std::vector<std::exception_ptr> faults;
    try {
      faults = batch_.advance(ahead, logs_);
    } catch (const std::exception&) {
      faults.assign(ahead.size(), std::current_exception());
    }
    team_.run([&](int rank) {
      for (std::size_t k = static_cast<std::size_t>(rank); k < runs_.size();
           k += static_cast<std::size_t>(team_.size()))
        if (runs_[k]) guarded(k, [&] { take(k, faults[k]); });
    });
  }

  void take(std::size_t k, const std::exception_ptr& fault) {
    if (fault) std::rethrow_exception(fault);
    if (!logs_[k].platform.empty()) runs_[k]->take(logs_[k]);
  }

  EngineBatch& batch_;
  const std::vector<RunOptions>& options_;
  std::vector<StepLog> logs_;
  std::vector<BatchEnd> ends_;
  std::vector<std::unique_ptr<RunSteps>> runs_;  // null: the run is over
  ThreadTeam team_;
};

}  // namespace

std::vector<BatchEnd> run_batch(const std::vector<SceneDef>& scenes, EngineBatch& batch,
                                const std::vector<RunOptions>& options, int recorders) {
  const CrashMessage last_words(options.empty() ? std::string() : options.front().output);
  return BatchRun(scenes, batch, options, recorders).go();
}

}  // namespace gem
