// Mends a run file that a killed program, a full disk or an older version of gem left.
#pragma once

#include <string>
#include <vector>

namespace gem {

/// What a repair did.
struct RepairReport {
  std::string output;             ///< the new file; empty: nothing was wrong, none was made
  std::vector<std::string> done;  ///< one line for each thing that was mended
};

/// Copies the file to `output` and mends the copy; the file itself stays as it is. All datasets of a group get the same
/// length, that of their rows that stand in the file; zeros behind the last time go; a file that was not closed gets
/// the status "stopped:killed" and opens like any other. Throws Error(file_system) if the file cannot be read, is in
/// use, or the output exists (and not overwrite).
RepairReport repair_run_file(const std::string& path, const std::string& output, bool overwrite);

}  // namespace gem
