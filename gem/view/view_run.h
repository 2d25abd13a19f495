// Shows a run file: as one page file, or in a browser from a server of this process.
#pragma once

#include <string>

namespace gem::view {

/// Writes the page of a run file to `out`. An existing file is replaced if it is a page of the same case, or with
/// `overwrite`. Throws Error(file_system) if the run file cannot be read or the page cannot be written.
void write_page(const std::string& run_file, const std::string& out, bool allow_incomplete, bool overwrite);

}  // namespace gem::view
