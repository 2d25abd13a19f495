// gem run: runs one case and writes one run file.
#include <algorithm>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/run/run_choice.h"
#include "gem/field/field.h"
#include "gem/field/files/floe_file.h"
#include "gem/record/output/output_path.h"
#include "gem/run/checkpoint/checkpoint_path.h"
#include "gem/run/run_signals.h"
#include "gem/scene/check_scene.h"
#include "gem/scene/toml/document.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {

namespace {

/// Options that the chosen engine would ignore are refused.
void check_engine_options(const RunChoice& choice) {
  const std::string& engine = choice.engine.name;
  for (const CLI::Option* option : choice.baseline_options)
    if (option->count() > 0 && !is_baseline(engine))
      throw Error(ExitCode::usage, option->get_name() + " has no effect on the engine " + engine + " (it is for " +
                                       baseline_names().front() + "); leave it out");
  if (engine == "cpu" || engine == "auto" || choice.threads.empty() || choice.threads == "1") return;
  throw Error(ExitCode::usage, "--threads " + choice.threads + " has no effect on the engine " + engine +
                                   " (only the engine cpu uses threads); leave it out");
}

/// The built-in case takes long: it runs only for somebody who changes it or says how far.
void check_case_is_named(const RunChoice& choice) {
  const CaseChoice& chosen = choice.chosen_case;
  if (!chosen.path.empty() || !chosen.overrides.empty() || chosen.index || !choice.until.empty() || choice.dry_run)
    return;
  throw Error(
      ExitCode::usage,
      "no case (gem run computes the case of a file); name one, e.g. gem run cases/first.toml; the built-in case "
      "runs with --until or --set, e.g. gem run --until 10min");
}

/// Whoever types the command of a stopped run again is told how it goes on.
void check_no_unfinished_run(const std::string& path) {
  if (!std::filesystem::exists(path) || !has_checkpoint(path)) return;
  throw Error(ExitCode::file_system, "cannot write " + shown(path) +
                                         " (the file holds a run that has not ended); go on with gem run --continue " +
                                         shown(path) + ", or use --overwrite or another --out");
}

/// The case with its end. An --until beyond the end of the case moves that end; one before it stops the run there, so
/// that it can go on later.
SceneDef case_until(RunChoice& choice, RunLog& log) {
  if (choice.until.empty()) return read_case(choice.chosen_case);
  const double seconds = until_of(choice);
  for (const std::string& text : choice.chosen_case.overrides)
    if (find_path(parse_override(text), "run.duration_s") != nullptr)
      throw Error(ExitCode::usage, "--until " + choice.until + " and --set " + text +
                                       " both set the end of the run (one would be ignored); give only one");
  CaseChoice moved = choice.chosen_case;
  moved.overrides.push_back("--until run.duration_s=" +
                            (parse_number(choice.until) ? choice.until : number_text(seconds)));
  SceneDef until = read_case(moved);
  SceneDef whole = read_case(choice.chosen_case);
  if (steps_of(until) > steps_of(whole) && !choice.chosen_case.path.empty())
    log.message("info", "--until " + choice.until + " is beyond the end of the case (" +
                            number_text(whole.run.duration_s) + " s): the run goes on to there");
  if (steps_of(until) >= steps_of(whole) || steps_of(until) == 0) return until;
  choice.options.step_limit = std::llround(seconds / whole.numerics.time_step_s);
  return whole;
}

/// `place` names the device or the threads that compute.
std::string dry_run_text(const SceneDef& scene, const Bodies& field, const Estimate& need, const RunChoice& choice,
                         const std::string& place) {
  const std::size_t floes = std::size_t(std::count(field.kind.begin(), field.kind.end(), BodyKind::floe));
  if (choice.json) {
    const nlohmann::ordered_json object = {{"name", scene.run.name},
                                           {"case_sha256", scene_hash(scene)},
                                           {"engine", choice.engine.name},
                                           {"threads", choice.engine.threads},
                                           {"floes", floes},
                                           {"steps", need.steps},
                                           {"memory_bytes", need.memory},
                                           {"disk_bytes", need.disk},
                                           {"file", choice.options.output}};
    return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  }
  return resolved_toml(scene) + "\n# dry run: nothing was computed\n# case    " + scene_hash(scene) + "\n# floes   " +
         std::to_string(floes) + "\n# time steps " + fixed_text(need.steps, 0) + "\n# engine  " + choice.engine.name +
         ", " + place + "\n# memory  about " + size_text(need.memory) + "\n# disk    about " + size_text(need.disk) +
         " in " + shown(choice.options.output) + "\n";
}

int run(RunChoice choice) {
  choice.options.log = {progress_mode(choice.progress), choice.options.log.quiet, choice.log_format == "json"};
  RunLog log(choice.options.log);
  std::string thread_message;
  choice.engine.threads = choose_threads(choice.threads, thread_message);
  check_engine_options(choice);
  if (!thread_message.empty()) log.message("warning", thread_message);

  if (!choice.continued.empty()) return continue_run(choice, log);
  check_case_is_named(choice);
  const SceneDef scene = case_until(choice, log);
  if (choice.chosen_case.path.empty())
    log.message("info", "no case file: running the built-in case " + scene.run.name + ", " +
                            number_text(scene.run.duration_s / 60.0, 4) +
                            " min of drift; gem run FILE runs another, --until 10min stops sooner");
  for (const std::string& warning : scene_warnings(scene)) log.message("warning", warning);
  if (choice.options.output.empty()) choice.options.output = run_file_name(scene.run.name);
  if (!choice.dry_run) {
    if (!choice.options.overwrite) check_no_unfinished_run(choice.options.output);
    check_output_path(choice.options.output, choice.options.overwrite);
    check_replaceable(choice.options.output);
  }
  const SceneDef listed = with_floes_of_run_file(scene);
  if (const std::string cut = concave_floes_text(scene); !cut.empty()) log.message("info", "floes.concave: " + cut);
  const Estimate need = estimate(listed, choice.options.checkpoint_interval_s > 0.0);
  if (!choice.force) check_resources(need, choice.options.output);

  if (!choice.dry_run) start_live_view(choice, log);
  const Bodies field = make_field(listed);
  const auto engine = engine_for(listed, field, choice.engine);
  choice.engine.name = engine->name();
  if (choice.engine.name != "cpu") choice.engine.threads = 1;
  const std::string place = engine->device().empty() ? threads_text(choice.engine.threads) : engine->device();
  if (choice.dry_run) {
    print(dry_run_text(scene, field, need, choice, place));
    return 0;
  }
  log.message("info", scene.run.name + ": " + number_text(scene.run.duration_s) + " s, engine " + engine->name() +
                          ", " + place + ", to " + shown(choice.options.output));
  if (scene.floe.empty()) choice.options.floes_of_engine = listed.floe;
  return run_and_print(scene, *engine, choice, log);
}

/// Adds the options of the registered baselines.
void add_baseline_options(CLI::App& command, RunChoice& choice) {
  std::vector<std::string>& chosen = choice.engine.baseline_settings;
  std::string experiments;
  for (const BaselineSetting& setting : baseline_settings()) {
    if (setting.flag.empty()) {
      experiments += (experiments.empty() ? "" : ", ") + setting.key;
      continue;
    }
    const auto choose = [&chosen, key = setting.key](const double& value) {
      chosen.push_back(key + "=" + number_text(value));
    };
    choice.baseline_options.push_back(
        command.add_option_function<double>(setting.flag, choose, setting.meaning)->default_str(setting.preset));
  }
  if (experiments.empty()) return;
  const auto choose = [&chosen](const std::vector<std::string>& texts) {
    chosen.insert(chosen.end(), texts.begin(), texts.end());
  };
  choice.baseline_options.push_back(
      command
          .add_option_function<std::vector<std::string>>(
              "--experiment", choose, "one setting of " + baseline_names().front() + " to change: " + experiments)
          ->type_name("KEY=VALUE")
          ->allow_extra_args(false));
}

/// Adds --continue, --checkpoint-every and --flush-every.
void add_checkpoint_options(CLI::App& command, RunChoice& choice) {
  CLI::Option* go_on = command.add_option("--continue", choice.continued,
                                          "go on with a run that stopped or was killed, from its last checkpoint, to "
                                          "the bits of a run that never stopped; its case and its end are in the file");
  go_on->type_name("RUNFILE");
  for (const char* other : {"case", "--set", "--index", "--from", "--out", "--overwrite", "--dry-run"})
    go_on->excludes(command.get_option(other));
  choice.options.checkpoint_interval_s = usual_checkpoint_interval_s;
  command
      .add_option("--checkpoint-every", choice.options.checkpoint_interval_s,
                  "wall time between two checkpoints, the first one after a second at most; 0: none at all")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  add_flush_option(command, choice.options.flush_interval_s);
}

}  // namespace

void add_flush_option(CLI::App& command, double& interval_s) {
  command
      .add_option(
          "--flush-every", interval_s,
          "wall time after which a run file shows its new rows to readers, the first ones after a second at most")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
}

void add_run_command(CLI::App& app, Chosen& chosen) {
  const auto choice = std::make_shared<RunChoice>();
  CLI::App* command = app.add_subcommand("run", "run a case and write a run file");
  add_case_options(*command, choice->chosen_case, false);
  command->get_option("case")->description(
      "case file (TOML); without one the built-in case, which needs --until, --set or --dry-run");
  command
      ->add_option("--from", choice->chosen_case.from,
                   "begin with the floes and the platform of a run, at its last recorded frame or at the one of a "
                   "time, e.g. @1.3h")
      ->type_name("RUNFILE[@TIME]")
      ->check(not_empty());
  command->add_option("-o,--out", choice->options.output, "run file; default: the run's name with .h5")
      ->check(not_empty());
  choice->engine.name = "auto";
  choice->engine_option =
      command->add_option("--engine", choice->engine.name, "engine; auto: cuda if a GPU can take the case, else cpu")
          ->check(CLI::IsMember(engine_choices()))
          ->capture_default_str();
  command->add_option("--threads", choice->threads, "threads of the cpu engine; default: one per processor")
      ->type_name("N");
  add_baseline_options(*command, *choice);
  command
      ->add_option("--until", choice->until,
                   "end of the run; before the case's end the run stops there and can go on, beyond it sets "
                   "run.duration_s; in s, or with its unit, e.g. 20min")
      ->type_name("TIME");
  command->add_flag("--overwrite", choice->options.overwrite, "replace an existing run file");
  command->add_flag("--dry-run", choice->dry_run, "check the case and print what the run needs, without running it");
  add_checkpoint_options(*command, *choice);
  command
      ->add_flag("--view", choice->view,
                 "show the run in the browser while it goes on; it can be paused and stopped there")
      ->excludes(command->get_option("--dry-run"));
  command->add_flag("--no-browser", choice->no_browser, "with --view: print the address and open nothing")
      ->needs(command->get_option("--view"));
  command->add_flag("--force", choice->force, "run even if memory or disk seem too small");
  command->add_flag("--strict", choice->strict, "exit code 6 if the verdict on the run is bad");
  command->add_option("--progress", choice->progress, "progress on standard error")
      ->check(CLI::IsMember({"auto", "none", "line", "json"}))
      ->capture_default_str();
  command->add_flag("-q,--quiet", choice->options.log.quiet, "errors only");
  command->add_option("--log-format", choice->log_format, "messages on standard error")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command->add_flag("--json", choice->json, "summary as JSON");
  command->footer(
      "Every run ends with a verdict: good, doubtful or bad, with its reasons. It is in the run file, see `gem info`.");
  command->callback([choice, &chosen] {
    choice->options.command_line = chosen.command_line;
    chosen.json_messages = choice->log_format == "json";
    chosen.action = [choice] { return run(*choice); };
  });
}

}  // namespace gem
