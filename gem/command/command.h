// The commands of the program: each adds its options and leaves an action to be run after parsing.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gem/run/run_scene.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// What the user chose: the action returns the exit code.
struct Chosen {
  std::string command_line;
  bool json_messages = false;  // on standard error, the last one of a fault too
  std::function<int()> action;
};

/// Parses the command line of a program whose commands are added, runs the chosen one, and turns every fault into one
/// line and the exit code that it returns. A call without a command shows the help and is a fault too.
int run_command_line(CLI::App& app, Chosen& chosen, int argc, char** argv);

void add_run_command(CLI::App& app, Chosen& chosen);
void add_case_command(CLI::App& app, Chosen& chosen);
void add_sweep_command(CLI::App& app, Chosen& chosen);
void add_info_command(CLI::App& app, Chosen& chosen);
void add_report_command(CLI::App& app, Chosen& chosen);
void add_analyse_command(CLI::App& app, Chosen& chosen);
void add_devices_command(CLI::App& app, Chosen& chosen);

/// A case file and what is changed in it.
struct CaseChoice {
  std::string path;  // empty: the case built into the program
  std::vector<std::string> overrides;
  std::optional<long long> index;  // of a sweep
};

/// Adds the case file, --set and --index to a command.
void add_case_options(CLI::App& command, CaseChoice& choice, bool required);

/// Reads the chosen case. Throws Error(usage) for a sweep without --index and for a case with it.
SceneDef read_case(const CaseChoice& choice);

/// The scene with the floes of a run file listed, if its floe source is one; otherwise the scene itself. Fields and
/// engines are made of this: an engine's reach follows how fast listed floes are. Throws Error(scene_rejected) for a
/// run file without floes and for what is refused of listed ones.
SceneDef with_floes_of_run_file(const SceneDef& scene);

/// Writes to standard output. Throws Error(file_system) if that fails for another reason than a closed pipe.
void print(const std::string& text);

/// The threads to use: what was asked for, or OMP_NUM_THREADS, or all. What the environment says amiss, and more than
/// four times the processors, is clamped and `message` says so; --threads below 1 throws Error(usage).
int choose_threads(const std::string& asked, std::string& message);

/// Makes the chosen engine; `auto` stands for cuda where a GPU can take the scene and for cpu where none can.
std::unique_ptr<Engine> engine_for(const SceneDef& scene, const Bodies& field, const EngineOptions& options);

/// What --engine takes: auto and every engine of this build.
std::vector<std::string> engine_choices();

/// A baseline's books are reported, not enforced: it computes in float and closes them as well as that allows.
inline constexpr BookLimits reported_only{HUGE_VAL, HUGE_VAL, HUGE_VAL};

/// auto, none, line or json.
ProgressMode progress_mode(const std::string& name);

/// The file that a run is written to if nothing else is said: its name without slashes, and .h5.
std::string run_file_name(const std::string& run_name);

/// What a run needs, estimated before anything is allocated.
struct Estimate {
  double steps = 0.0;
  double memory = 0.0;         // [bytes]
  double disk = 0.0;           // [bytes], without the events
  double platform_disk = 0.0;  // of that what the platform's samples take
};
Estimate estimate(const SceneDef& scene);

/// Throws Error(resource_limit) if the estimate is beyond the free memory, or beyond the free disk at `output`.
void check_resources(const Estimate& need, const std::string& output);

/// 12.3 MB and the like.
std::string size_text(double bytes);

std::string summary_text(const RunSummary& summary);
std::string summary_json(const RunSummary& summary);

}  // namespace gem
