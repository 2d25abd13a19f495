// The page of a sweep: a matrix of small pictures and loads, and a table with one row per run.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gem {

/// A run of a sweep as the page takes it.
struct SweepPageRun {
  std::string name;
  std::string path;    // of its run file; empty: it is only listed
  std::string status;  // done, running, ... as `gem sweep status` says it
};

/// Writes out_dir/index.html with its figures. Each picture shows the ice around the platform at `at_s`, else when the
/// ice force was largest. Runs are read one after another. Throws Error(file_system) if a file cannot be read, gnuplot
/// is missing or something cannot be written; Error(usage) if no run has a file or the folder holds another page.
void write_sweep_report(const std::string& sweep, const std::vector<SweepPageRun>& runs, const std::string& out_dir,
                        std::optional<double> at_s = {});

}  // namespace gem
