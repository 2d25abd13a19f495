// The manifest of a sweep: one row for each run.
#pragma once

#include <string>
#include <vector>

#include "gem/command/sweep/folder/sweep_row.h"

namespace gem {

/// Rows of FOLDER/manifest.json by index, with what manifest.updates says since; empty without a manifest. Throws
/// Error(file_system) if the manifest is damaged.
std::vector<SweepRow> read_manifest(const std::string& folder);

/// Replaces the rows of these names. Any number of processes may call this: it takes the manifest's lock. The rows go
/// to the end of manifest.updates, so that the work does not grow with the number of runs. When that file has become
/// larger than the manifest, the manifest is written anew. Throws Error(file_system).
void update_manifest(const std::string& folder, const std::vector<SweepRow>& rows);

/// Writes the manifest with all updates, and removes them. Throws Error(file_system).
void settle_manifest(const std::string& folder);

/// Replaces the rows of these names and writes the manifest, or makes it; for a caller that holds the manifest's lock.
/// Throws Error(file_system).
void write_manifest(const std::string& folder, const std::vector<SweepRow>& rows);

}  // namespace gem
