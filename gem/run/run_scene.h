// The only loop over time: moves an engine to the end of its scene, records, checks the books and can be stopped.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "gem/engine/engine.h"
#include "gem/run/run_log.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Largest share of momentum and energy that the books may leave unexplained: rounding over 72 hours stays below.
struct BookLimits {
  double momentum = 1e-11;
  double angular_momentum = 1e-11;
  double energy = 1e-8;
};

struct RunOptions {
  std::string output;  ///< run file; empty: nothing is written
  bool overwrite = false;
  LogOptions log;
  BookLimits books;
  double flush_interval_s = 5.0;           ///< wall time between two flushes
  std::int64_t step_limit = 0;             ///< > 0: stop after so many time steps
  std::string command_line = "gem";        ///< for the file's history
  int threads = 1;                         ///< the same
  const std::atomic<int>* stop = nullptr;  ///< number of a signal to stop for besides this process's own; may be null
  std::function<void(double)> on_block = {};  ///< is told the simulated time [s] after each block of time steps
};

/// What a run came to.
struct RunSummary {
  std::string status;   // complete | stopped:<reason>
  int stop_signal = 0;  // SIGINT, SIGTERM, SIGHUP or 0
  std::string file;
  std::string engine;
  double time = 0.0;       // simulated [s]
  double wall_time = 0.0;  // [s]
  double sim_rate = 0.0;   // simulated over wall time
  std::int64_t steps = 0;
  std::int64_t frames = 0;
  std::int64_t events = 0;
  std::uint64_t state_hash = 0;
  LedgerResidual residual;     // largest over all floe frames
  StepQuality worst;           // of all time steps
  std::int64_t at_limit = 0;   // coupled time steps that ended because no more iterations were allowed
  OverlapCount overlap;        // of all time steps [m]
  OverlapCount overlap_share;  // over the size of the smaller body [-]
  double active_floes = 0.0;
  double peak_memory = 0.0;  // of the process [bytes]
};

/// Runs the engine from where it stands (time step 0) to the end of the scene. Throws Error(file_system) if the record
/// cannot be written and Error(numerical_stop) if the state or the books go wrong; the file then says so.
RunSummary run_scene(const SceneDef& scene, Engine& engine, const RunOptions& options);

/// Number of the signal for which a run is to stop now; 0: none.
int stop_signal_of(const RunOptions& options);

/// Time steps of a whole run: the duration over the time step, rounded.
std::int64_t steps_of(const SceneDef& scene);

}  // namespace gem
