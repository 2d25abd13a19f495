// Whether the parts of a checkpoint fit together, so that no engine and no recorder reads behind the end of an array.
#pragma once

#include <string>

#include "gem/run/checkpoint/checkpoint.h"

namespace gem {

/// What does not fit; empty if all is well.
std::string fault_of(const Checkpoint& checkpoint);

}  // namespace gem
