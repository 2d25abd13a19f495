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
/// to the end of manifest.updates, so that the work does not grow with the number of runs. When that file would become
/// larger than the manifest, the manifest is written anew. Throws Error(file_system).
void update_manifest(const std::string& folder, const std::vector<SweepRow>& rows);

/// Writes the manifest with all updates, and removes them. Throws Error(file_system).
void settle_manifest(const std::string& folder);

/// Replaces the manifest atomically and removes the updates; for a caller that holds the manifest's lock. Throws
/// Error(file_system).
void write_manifest(const std::string& folder, const std::vector<SweepRow>& rows);

/// `all` with the rows of `newer` in place of those of the same name, by index.
std::vector<SweepRow> laid_over(std::vector<SweepRow> all, const std::vector<SweepRow>& newer);

}  // namespace gem
