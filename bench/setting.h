// Engines and settings that are compared from one state: reads them from a file, starts and times them.
#pragma once

#include <string>
#include <vector>

#include "gem/command/command.h"
#include "gem/engine/engine.h"

namespace gem::bench {

/// One line of a settings file: label | engine | options | scene overrides
///   options: threads= velocity_iterations= position_iterations= skin= warm= step_factor= and Box2D's experiments
///   warm=1: starts from the leader's last impulses (only gem's coupled solver), scaled to its own time step
///   step_factor: factor on the time step of the case
struct EngineSetting {
  std::string label;
  EngineOptions engine;
  std::vector<std::string> overrides;
  bool warm = false;
  double step_factor = 1.0;
  SceneDef scene;
};

/// Throws Error(file_system) if the file cannot be opened, and Error(usage) for an unknown option.
std::vector<EngineSetting> read_settings(const std::string& path, const CaseChoice& chosen_case);

/// A case file; a member of a sweep as FILE#INDEX.
CaseChoice case_named(const std::string& text);

/// Reads a number. Throws Error(usage) that names `what`.
double number_of(const std::string& text, const std::string& what);

/// The whole main() of a program: registers Box2D, calls `run` with the arguments and reports errors.
int run_program(const char* name, int (*run)(const std::vector<std::string>&), int argc, char** argv);

/// The state at the start of a window.
struct Start {
  EngineState state;
  double time_step_s = 0.0;  // of the leader
  double time = 0.0;         // [s]
};

/// An engine with this setting at the start state. Without warm=1 the last impulses are dropped.
std::unique_ptr<Engine> engine_at(const EngineSetting& setting, const Start& start);

/// Number of time steps of a setting in a stretch of time.
std::int64_t steps_in(const EngineSetting& setting, double seconds);

/// Time used by this process.
struct Spent {
  double user = 0.0, wall = 0.0;  // [s]
};
Spent spent_so_far();
inline Spent operator-(Spent a, Spent b) { return {a.user - b.user, a.wall - b.wall}; }
inline void operator+=(Spent& a, Spent b) { a = {a.user + b.user, a.wall + b.wall}; }

/// NaN if there are no values.
double median(std::vector<double> values);

/// Distances between the positions of floes in two fields, over the floes active in both [m].
struct FloeDistance {
  double rms = 0.0, largest = 0.0;
  double count = 0.0;
};
FloeDistance floe_distance(const Bodies& a, const Bodies& b);

std::string hex(std::uint64_t value);

}  // namespace gem::bench
