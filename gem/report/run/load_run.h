// Reads what a report needs from a run file.
#pragma once

#include <optional>
#include <string>

#include "gem/report/run/run_data.h"

namespace gem {

/// Three frames of the floes (start, middle, end) and all other records. Throws Error(file_system) if the file cannot
/// be read, is not a run file, or is incomplete (unless `allow_incomplete`). With `at_s` the second frame is the one
/// nearest to that time.
RunData load_run(const std::string& run_file, bool allow_incomplete, std::optional<double> at_s = {});

}  // namespace gem
