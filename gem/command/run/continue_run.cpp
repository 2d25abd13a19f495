// gem run --continue: goes on with a run from its last checkpoint.
#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/run/run_choice.h"
#include "gem/record/output/output_claim.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/run/checkpoint/resume.h"

namespace gem {
namespace {

bool is_complete(const std::string& run_file) { return RunFile(run_file, true).status() == "complete"; }

/// The time steps up to --until.
std::int64_t limit_of(const RunChoice& choice, const Resumable& run) {
  if (choice.until.empty()) return 0;
  const double dt = run.scene.numerics.time_step_s, now = static_cast<double>(run.from->engine.step) * dt;
  const double seconds = until_of(choice);
  if (seconds > now && seconds <= run.scene.run.duration_s) return std::llround(seconds / dt);
  throw Error(ExitCode::usage, "--until " + choice.until + " is not a time to go on to (allowed above " +
                                   number_text(now, 10) + ", the time of the checkpoint, up to " +
                                   number_text(run.scene.run.duration_s) + ", the end of the case); choose another");
}

/// Without --engine: cuda or cpu, which have the same bits, or the engine that the run had.
void choose_engine(RunChoice& choice, const Resumable& run, RunLog& log) {
  const std::string& before = run.from->engine_name;
  std::string& engine = choice.engine.name;
  if (choice.engine_option->count() == 0 && before == "reference") engine = before;
  if (is_baseline(engine))
    throw Error(ExitCode::usage,
                "the engine " + engine + " cannot go on with a run (it keeps no checkpoints); choose another engine");
  if ((engine == "reference") != (before == "reference"))
    log.message("warning", "the run had the engine " + before + ", and goes on with " + engine +
                               ": its bits are no longer those of one engine");
}

}  // namespace

int continue_run(RunChoice& choice, RunLog& log) {
  const std::string& file = choice.options.output = choice.continued;
  tried_in_child({{file}}, [&] { resumable(file); });
  if (is_complete(file)) {
    log.message("info", shown(file) + " is complete: nothing to continue");
    return 0;
  }
  check_unclaimed(file);  // only now: a reader may hold a complete file
  check_output_path(file, true);
  const Resumable run = resumable(file);
  if (!run.note.empty()) log.message("warning", run.note);
  choice.options.step_limit = limit_of(choice, run);
  choose_engine(choice, run, log);
  start_live_view(choice, log);
  const auto engine = engine_for(run.engine_scene, run.from->engine.bodies, choice.engine);
  choice.engine.name = engine->name();
  if (choice.engine.name != "cpu") choice.engine.threads = 1;
  log.message("info", run.scene.run.name + ": goes on from " +
                          number_text(static_cast<double>(run.from->engine.step) * run.scene.numerics.time_step_s, 10) +
                          " s to " + number_text(run.scene.run.duration_s) + " s, engine " + engine->name() + ", " +
                          (engine->device().empty() ? threads_text(choice.engine.threads) : engine->device()) +
                          ", in " + shown(file));
  go_on(choice.options, run);
  return run_and_print(run.scene, *engine, choice, log);
}

}  // namespace gem
