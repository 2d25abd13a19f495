// Runs another program without a shell, so that no path needs quoting.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gem {

struct ProgramResult {
  bool found = true;   // false: no such program
  int exit_code = 0;   // 128 + signal if it was killed
  std::string output;  // stdout and stderr on one line, at most 300 characters
};

/// Starts `command` (found in PATH) in `folder` and waits for it. Throws Error(resource_limit) if no process can be
/// started.
ProgramResult run_program(const std::vector<std::string>& command, const std::filesystem::path& folder);

}  // namespace gem
