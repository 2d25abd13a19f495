// What `gem run` was asked, and the steps that a new run and one that goes on share.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gem/command/command.h"
#include "gem/command/run/live_view.h"

namespace gem {

struct RunChoice {
  CaseChoice chosen_case;
  std::string continued;  // run file to go on with; empty: a new run
  std::string until;      // [s]
  std::string threads;
  EngineOptions engine;
  RunOptions options;
  std::string progress = "auto";
  std::string log_format = "text";
  bool dry_run = false;
  bool force = false;
  bool json = false;
  bool strict = false;
  bool view = false;  // show the run while it goes on
  bool no_browser = false;
  std::shared_ptr<LiveView> live = nullptr;
  std::vector<const CLI::Option*> baseline_options;
  const CLI::Option* engine_option = nullptr;
};

/// Adds --flush-every, which `gem run` and `gem sweep run` share.
void add_flush_option(CLI::App& command, double& interval_s);

/// The number after --until [s]. Throws Error(usage) for anything else.
double until_of(const RunChoice& choice);

/// "2 threads".
std::string threads_text(int threads);

/// With --view: starts the page of the run that writes `choice.options.output`.
void start_live_view(RunChoice& choice, RunLog& log);

/// Runs the scene, prints the summary and returns the exit code.
int run_and_print(const SceneDef& scene, Engine& engine, RunChoice& choice, RunLog& log);

/// Goes on with the run file `choice.continued`.
int continue_run(RunChoice& choice, RunLog& log);

}  // namespace gem
