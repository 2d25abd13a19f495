#include "gem/command/run/run_choice.h"

#include <charconv>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/base/error.h"
#include "gem/command/time_option.h"
#include "gem/command/verdict_output.h"
#include "gem/record/output/output_path.h"
#include "gem/record/schema.h"
#include "gem/run/run_signals.h"

namespace gem {

double until_of(const RunChoice& choice) {
  double seconds = 0.0;
  const char* const end = choice.until.data() + choice.until.size();
  const auto read = std::from_chars(choice.until.data(), end, seconds);
  if (read.ec == std::errc{} && read.ptr == end && seconds >= 0.0) return seconds;
  return time_of_option("--until", choice.until);
}

std::string threads_text(int threads) { return std::to_string(threads) + (threads == 1 ? " thread" : " threads"); }

void start_live_view(RunChoice& choice, RunLog& log) {
  if (choice.view) choice.live = std::make_shared<LiveView>(choice.options.output, !choice.no_browser, log);
}

int run_and_print(const SceneDef& scene, Engine& engine, RunChoice& choice, RunLog& log) {
  choice.options.threads = choice.engine.threads;
  if (!engine.method().empty()) choice.options.books = reported_only;
  if (choice.live) choice.live->join(choice.options, scene.run.duration_s);
  const RunSummary summary = run_scene(scene, engine, choice.options);
  if (!choice.options.log.quiet || choice.json)
    print_about_file(choice.json ? summary_json(summary) : summary_text(summary));
  if (summary.status != "complete" && choice.options.checkpoint_interval_s > 0.0 && engine.method().empty())
    log.message("info", "it can go on: gem run --continue " + shown(summary.file));
  const bool has_floes = engine.bodies().count() > first_floe(engine.bodies());
  if (scene.platform.present && has_floes && summary.loaded_steps == 0 && summary.status == "complete")
    log.message("warning",
                "no ice touched the platform in the whole run (it drifts past or away, or needs longer); see "
                "where it goes: gem view " +
                    shown(summary.file));
  if (choice.live) choice.live->end(log);
  if (summary.verdict.grade == Grade::bad) {
    const std::string text = "the run " + scene.run.name + " is bad (" +
                             criteria_of_grade(summary.verdict, Grade::bad) + "); see its verdict: gem info " +
                             shown(summary.file);
    if (choice.strict && summary.stop_signal == 0) throw Error(ExitCode::numerical_stop, text);
    log.message("warning", text);
  }
  return exit_code_of_signal(summary.stop_signal);
}

}  // namespace gem
