// The time loop of one scene.
#include "gem/run/run_scene.h"

#include "gem/run/crash_message.h"
#include "gem/run/run_signals.h"
#include "gem/run/run_steps.h"

namespace gem {

int stop_signal_of(const RunOptions& options) {
  const int own = StopSignals::received();
  return own != 0 || options.stop == nullptr ? own : options.stop->load();
}

RunSummary run_scene(const SceneDef& scene, Engine& engine, const RunOptions& options) {
  const CrashMessage last_words(options.output);
  RunSteps run(scene, engine, options);
  const StopSignals signals;
  run.begin();
  StepLog log;
  try {
    while (!run.at_end() && stop_signal_of(options) == 0) {
      run.prepare(log);
      engine.advance(run.steps_ahead(), log);
      run.take(log);
    }
    run.last_rows();
  } catch (const std::exception& error) {
    run.fail(error);
    throw;
  }
  return run.finish(stop_signal_of(options));
}

}  // namespace gem
