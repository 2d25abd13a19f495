// The time loop of a run: advances an engine to the end of its scene, records, checks the books, stops on signals.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/record/verdict.h"
#include "gem/run/run_log.h"
#include "gem/scene/scene_def.h"

namespace gem {

struct Checkpoint;

/// Largest relative residuals of the books. Rounding over 72 hours of simulated time stays below them.
struct BookLimits {
  double momentum = 1e-11;
  double angular_momentum = 1e-11;
  double energy = 1e-8;
};

/// Wall time between two checkpoints [s]. A run that is killed redoes this much, what a checkpoint takes, and what its
/// cost adds, see RunSteps::checkpoint().
inline constexpr double usual_checkpoint_interval_s = 3.0;

/// Wall time between two flushes of the run file [s]. A run that is killed loses this much and what a flush takes.
inline constexpr double usual_flush_interval_s = 4.0;

struct RunOptions {
  std::string output;  ///< run file; empty: no file
  bool overwrite = false;
  LogOptions log;
  BookLimits books;
  double flush_interval_s = usual_flush_interval_s;  ///< wall time; 0: after every block of time steps
  std::int64_t step_limit = 0;         ///< > 0: stop after so many time steps; a checkpoint can go on from there
  double checkpoint_interval_s = 0.0;  ///< wall time between two checkpoints; 0: none, not even at a stop
  /// Go on from here; `output` is the run file of the checkpoint. Null: begin at t = 0.
  std::shared_ptr<const Checkpoint> from = nullptr;
  /// The listed floes of the scene that the engine was made of, if the case names a run file for them.
  std::vector<FloeDef> floes_of_engine = {};
  std::string command_line = "gem";  ///< for the history attribute of the file
  int threads = 1;                   ///< for the history attribute of the file
  const std::atomic<int>* stop =
      nullptr;  ///< signal number to stop for, besides the process's own signals; may be null
  std::function<void(double)> on_block = {};  ///< called with the simulated time [s] after each block of time steps
};

/// Numbers of a run that grow with every time step. They can be copied byte by byte.
struct RunTotals {
  double wall_time = 0.0;  // [s]
  std::int64_t frames = 0;
  LedgerResidual residual;     // largest over all floe frames
  StepQuality worst;           // of all time steps
  std::int64_t at_limit = 0;   // coupled time steps that ended at the iteration limit
  OverlapCount overlap;        // of all time steps [m]
  ContactEnergy contact;       // compliant: at the last floe frame
  OverlapCount overlap_share;  // depth over the size (root of the area) of the smaller body
};

/// The result of a run.
struct RunSummary : RunTotals {
  std::string status;   // complete | stopped:<reason>
  int stop_signal = 0;  // SIGINT, SIGTERM, SIGHUP or 0
  std::string file;
  std::string engine;
  double time = 0.0;      // simulated [s]
  double sim_rate = 0.0;  // simulated over wall time
  std::int64_t steps = 0;
  bool compliant = false;         // contacts spring and crush in substeps
  std::int64_t loaded_steps = 0;  // with an ice force on the platform
  std::int64_t events = 0;
  std::vector<double> line_break_times;  // of each mooring line [s]; 0: it holds
  std::uint64_t state_hash = 0;
  double asked_residual = std::nan("");  // that ends the iterations [m/s]; NaN: the solver has none
  RunVerdict verdict;
  double active_floes = 0.0;
  double peak_memory = 0.0;  // of the process [bytes]
};

/// Runs the engine from its current state (time step 0), or from `options.from`, to the end of the scene. Throws
/// Error(file_system) if the
/// record cannot be written, and Error(numerical_stop) if the state is not finite or the books do not close; the file
/// then has that status.
RunSummary run_scene(const SceneDef& scene, Engine& engine, const RunOptions& options);

/// Number of the signal that asks the run to stop; 0: none.
int stop_signal_of(const RunOptions& options);

/// Number of time steps of the whole run: duration over time step, rounded.
std::int64_t steps_of(const SceneDef& scene);

}  // namespace gem
