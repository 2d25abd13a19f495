// The steps of one run of a sweep, from its place in the sweep file to its row in the manifest.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "gem/base/error.h"
#include "gem/command/sweep/sweep_board.h"
#include "gem/command/sweep/sweep_folder.h"
#include "gem/engine/engine.h"
#include "gem/run/run_scene.h"
#include "gem/scene/sweep/sweep.h"

namespace gem {

/// How all runs of a sweep are made.
struct SweepSettings {
  std::string folder;
  EngineOptions engine;
  bool overwrite = false;
  std::string command_line;
};

/// The row of a run that nothing is known of yet.
SweepRow row_of(const SweepMember& member);

/// Whether a run is not to be made by the holder of its lock; then `row` and the outcome say why.
std::optional<Outcome> reason_not_to(const SweepSettings& settings, SweepBoard::Entry& entry, SweepRow& row);

/// Puts it on the board and into the manifest that the run is under way.
void say_running(const SweepSettings& settings, SweepBoard::Entry& entry, SweepRow& row);

/// How the member is run into its file.
RunOptions options_of(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                      const std::atomic<int>& stop);

/// Fills the row from the summary of a run that did not fail.
Outcome outcome_of(const RunSummary& summary, SweepRow& row);

/// Fills the row with the reason of a failure.
Outcome failure(SweepRow& row, SweepBoard::Entry& entry, const std::string& why, ExitCode code);

/// The same of the exception that is being handled.
Outcome failure_now(SweepRow& row, SweepBoard::Entry& entry);

}  // namespace gem
