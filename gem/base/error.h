// The only exception type of the program: problem, reason, suggestion and exit code.
#pragma once

#include <stdexcept>
#include <string>

namespace gem {

enum class ExitCode : int {
  done = 0,
  usage = 2,
  scene_rejected = 3,
  file_system = 4,
  device = 5,
  numerical_stop = 6,  // the numbers failed and the run stopped, or --strict found it bad
  resource_limit = 7,
  some_failed = 8,  // some of several runs failed; each has its own reason
};

/// An error that the user can act on. `what()` is one line: problem (why) suggestion.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace gem
