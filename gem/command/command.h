// The commands of the program. Each adds its options and stores an action that runs after parsing.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gem/record/reading/reading_child.h"
#include "gem/run/run_scene.h"
#include "gem/scene/scene_def.h"
#include "gem/scene/sweep/sweep.h"

namespace gem {

/// What the user chose. The action returns the exit code.
struct Chosen {
  std::string command_line;
  bool json_messages = false;  // messages on standard error are JSON, the final error too
  std::function<int()> action;
  ReadInChild reading;   // files of strangers that the action reads: it runs in a child process then
  bool in_child = true;  // false: never, so that a fuzz target sees a crash
};

/// Parses the command line, runs the chosen command and returns the exit code. Any error is reported in one line. A
/// call without a command prints the help and is a usage error.
int run_command_line(CLI::App& app, Chosen& chosen, int argc, char** argv);

void add_run_command(CLI::App& app, Chosen& chosen);
void add_case_command(CLI::App& app, Chosen& chosen);
void add_sweep_command(CLI::App& app, Chosen& chosen);
void add_info_command(CLI::App& app, Chosen& chosen);
void add_report_command(CLI::App& app, Chosen& chosen);
void add_compare_command(CLI::App& app, Chosen& chosen);
void add_view_command(CLI::App& app, Chosen& chosen);
void add_export_command(CLI::App& app, Chosen& chosen);
void add_film_command(CLI::App& app, Chosen& chosen);
void add_repair_command(CLI::App& app, Chosen& chosen);
void add_analyse_command(CLI::App& app, Chosen& chosen);
void add_devices_command(CLI::App& app, Chosen& chosen);
/// The commands completion and manual, made from all commands of `app` when they are called.
void add_pages_commands(CLI::App& app, Chosen& chosen);
/// --version, and --version --json.
void add_version_option(CLI::App& app, Chosen& chosen);

/// A case file and what is changed in it.
struct CaseChoice {
  std::string path;  // empty: the built-in case
  std::vector<std::string> overrides;
  std::optional<long long> index;  // of a sweep
  std::string from;                // RUNFILE or RUNFILE@SECONDS that the floes and the platform come from; empty: none
};

/// Refuses an empty text: `--out ""` is a mistake in a script, not a wish for the default name.
CLI::Validator not_empty();

/// Adds the case file, --set and --index to a command.
void add_case_options(CLI::App& command, CaseChoice& choice, bool required);

/// Reads the chosen case, with named_floes(). Its file is read once, so that it may be a pipe. Throws Error(usage) for
/// a sweep without --index and for a case with it.
SceneDef read_case(const CaseChoice& choice);

/// The runs of a sweep file. Floe files are read and named as in named_floes().
std::vector<SweepMember> read_sweep(const std::string& path, const std::vector<std::string>& overrides);

/// The scene with the absolute path and the SHA-256 of its floe file, if it has one, so that the case and its hash hold
/// what the file holds. Throws Error if the file cannot be read, or holds other floes than the scene names.
SceneDef named_floes(SceneDef scene);

/// The scene with named_floes(). If the user chose a run to begin with, floes.source, path and time_s name it first,
/// and the platform starts as it was there, but for what --set says. Throws Error if the file has no such frame.
SceneDef begun_from(const CaseChoice& choice, SceneDef scene);

/// The scene with explicit floes if floes.source names a run file; otherwise the scene itself. Make fields and engines
/// from this scene, because an engine's contact reach depends on the speed of listed floes. Throws
/// Error(scene_rejected) if the run file has no floes or they fail the checks of listed floes.
SceneDef with_floes_of_run_file(const SceneDef& scene);

/// Writes to standard output. A pipe whose reader has gone is ignored; any other failure throws Error(file_system).
void print(const std::string& text);
/// The same for what is said about a file that was written: a closed output is ignored too.
void print_about_file(const std::string& text);
/// The same for what nothing else says: a pipe whose reader has gone throws too.
void print_needed(const std::string& text);

/// The number of threads: --threads, else OMP_NUM_THREADS, else all processors. An invalid OMP_NUM_THREADS is ignored
/// and a number above four times the processors is reduced; `message` then says so. Throws Error(usage) for --threads
/// below 1.
int choose_threads(const std::string& asked, std::string& message);

/// Whether the engine cuda has the contact solver of the scene.
bool has_solver_on_gpu(const SceneDef& scene);

/// Makes the chosen engine. `auto` is cuda if a GPU can take the scene, else cpu.
std::unique_ptr<Engine> engine_for(const SceneDef& scene, const Bodies& field, const EngineOptions& options);

/// The values of --engine: auto and every engine of this build.
std::vector<std::string> engine_choices();

/// Limits for a baseline: its books are reported, never enforced, because it computes in single precision.
inline constexpr BookLimits reported_only{HUGE_VAL, HUGE_VAL, HUGE_VAL};

/// `name` is auto, none, line or json.
ProgressMode progress_mode(const std::string& name);

/// Default name of the run file: the run's name with slashes replaced, and .h5.
std::string run_file_name(const std::string& run_name);

/// What a run needs, estimated before anything is allocated.
struct Estimate {
  double steps = 0.0;
  double memory = 0.0;           // [bytes]
  double disk = 0.0;             // [bytes], without the events
  double platform_disk = 0.0;    // the part taken by the platform's samples
  double checkpoint_disk = 0.0;  // the part that is free again when the run is done
};
/// `checkpoints`: whether the run keeps checkpoints, which stand beside its file.
Estimate estimate(const SceneDef& scene, bool checkpoints);

/// Throws Error(resource_limit) if the run needs more memory than is free, or more disk than is free at `output`.
void check_resources(const Estimate& need, const std::string& output);

/// A size for people, e.g. "12.3 MB".
std::string size_text(double bytes);

std::string summary_text(const RunSummary& summary);
std::string summary_json(const RunSummary& summary);

}  // namespace gem
