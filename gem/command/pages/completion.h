// The completion of the program for bash.
#pragma once

#include <string>
#include <vector>

#include "gem/command/pages/command_text.h"

namespace gem {

/// A script for bash that completes commands, options, the values of options with fixed choices, keys of a case, and
/// file names. `keys` are those of --set; `topics` those that `gem case explain` takes.
std::string bash_completion(const CommandText& program, const std::vector<std::string>& keys,
                            const std::vector<std::string>& topics);

}  // namespace gem
