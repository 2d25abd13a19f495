// Reads what a report needs from a run file.
#pragma once

#include <string>

#include "gem/report/run_data.h"

namespace gem {

/// Throws Error(file_system) if the file cannot be read or is no run file.
RunData load_run(const std::string& run_file);

}  // namespace gem
