// Engines with settings that are compared from one state: read from a file, started, and timed.
#pragma once

#include <string>
#include <vector>

#include "gem/command/command.h"
#include "gem/engine/engine.h"

namespace gem::bench {

/// One line of a settings file: label | engine | options | scene overrides
///   options: threads= velocity_iterations= position_iterations= skin= warm= moment_factor= and Box2D's experiments
///   warm=1: starts from the leader's last impulses (gem's coupled only), scaled to its own time step
///   moment_factor: of the time step that the case states
struct EngineSetting {
  std::string label;
  EngineOptions engine;
  std::vector<std::string> overrides;
  bool warm = false;
  double step_factor = 1.0;
  SceneDef scene;
};

/// Throws Error(file_system) for a file that does not open, Error(usage) for what it does not know.
std::vector<EngineSetting> read_settings(const std::string& path, const CaseChoice& chosen_case);

/// A case file; a member of a sweep as FILE#INDEX.
CaseChoice case_named(const std::string& text);

/// Throws Error(usage) that names `what`.
double number_of(const std::string& text, const std::string& what);

/// The whole of a program's main(): makes Box2D known, calls `run` with the arguments, and tells what went wrong.
int run_program(const char* name, int (*run)(const std::vector<std::string>&), int argc, char** argv);

/// Where a window begins.
struct Start {
  EngineState state;
  double time_step_s = 0.0;  // of the leader
  double time = 0.0;         // [s]
};

/// An engine of this setting at the start; without warm=1 its last impulses are forgotten.
std::unique_ptr<Engine> engine_at(const EngineSetting& setting, const Start& start);

/// Time steps of a setting in a stretch of time.
std::int64_t steps_in(const EngineSetting& setting, double seconds);

/// Of this process.
struct Spent {
  double user = 0.0, wall = 0.0;  // [s]
};
Spent spent_so_far();
inline Spent operator-(Spent a, Spent b) { return {a.user - b.user, a.wall - b.wall}; }
inline void operator+=(Spent& a, Spent b) { a = {a.user + b.user, a.wall + b.wall}; }

/// NaN without values.
double median(std::vector<double> values);

/// Distances of floes that both still have [m].
struct FloeDistance {
  double rms = 0.0, largest = 0.0;
  double count = 0.0;
};
FloeDistance floe_distance(const Bodies& a, const Bodies& b);

std::string hex(std::uint64_t value);

}  // namespace gem::bench
