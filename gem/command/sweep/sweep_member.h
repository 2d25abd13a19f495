// The steps of one run of a sweep, from the sweep file to the row in the manifest.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "gem/base/error.h"
#include "gem/command/sweep/folder/sweep_folder.h"
#include "gem/command/sweep/sweep_board.h"
#include "gem/engine/engine.h"
#include "gem/run/checkpoint/resume.h"
#include "gem/run/run_scene.h"
#include "gem/scene/sweep/sweep.h"

namespace gem {

/// Settings common to all runs of a sweep.
struct SweepSettings {
  std::string folder;
  EngineOptions engine;
  bool overwrite = false;
  std::string command_line;
  double checkpoint_interval_s = usual_checkpoint_interval_s;  // wall time; 0: no checkpoints
  double flush_interval_s = usual_flush_interval_s;            // wall time
};

/// The row of a run before anything is known of it.
SweepRow row_of(const SweepMember& member);

/// Empty if the holder of the run's lock must make the run; otherwise the outcome, and `row` says why.
std::optional<Outcome> reason_not_to(const SweepSettings& settings, SweepBoard::Entry& entry, SweepRow& row);

/// Reports on the board and in the row that the run has started.
void note_running(SweepBoard::Entry& entry, SweepRow& row);

/// The checkpoint from which the holder of the run's lock can go on; empty if the run begins at t = 0.
std::optional<Resumable> resumable_run(const SweepSettings& settings, const SweepRow& row);

/// The options with which the member is run.
RunOptions options_of(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                      const std::atomic<int>& stop);

/// Fills the row from the summary of a run that did not fail.
Outcome outcome_of(const RunSummary& summary, SweepRow& row);

/// Fills the row with the reason of a failure.
Outcome failure(SweepRow& row, SweepBoard::Entry& entry, const std::string& why, ExitCode code);

/// Fills the row with the exception that is being handled.
Outcome failure_now(SweepRow& row, SweepBoard::Entry& entry);

}  // namespace gem
