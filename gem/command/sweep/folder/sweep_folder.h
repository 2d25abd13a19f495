// The folder of a sweep: its run files, the manifest that lists them, and the locks that keep processes apart.
#pragma once

#include <string>
#include <vector>

#include "gem/command/sweep/folder/sweep_lock.h"
#include "gem/command/sweep/folder/sweep_row.h"

namespace gem {

std::string run_path(const std::string& folder, const std::string& run_name);

/// Called when a sweep starts. Adds the rows; an existing row of the same name and case is kept. Returns the sweep's
/// lock on the folder, to be held while the sweep runs. Throws Error(file_system) if another sweep running there has
/// other cases under these names.
SweepLock enter_folder(const std::string& folder, const std::vector<SweepRow>& rows);

/// The state of a run now. The lock tells whether it is running; otherwise the run file decides, whatever the manifest
/// says. Only a failure without a file is taken from `row`. `engine` is the requested engine (empty: any); a run made
/// by an engine with other physics counts as another run.
SweepRow look_at_run(const std::string& folder, SweepRow row, const std::string& engine = "");

/// The state of a run from its file alone, for the process that holds its lock.
SweepRow look_at_file(const std::string& folder, SweepRow row, const std::string& engine);

}  // namespace gem
