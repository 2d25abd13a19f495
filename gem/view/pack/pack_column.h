// One column of numbers as differences.
#pragma once

#include <vector>

#include "gem/view/pack/byte_writer.h"

namespace gem::view {

/// Writes the rows at which values begin or end to be missing (no number, or beyond 1e15 steps), then all values as
/// whole numbers of `step`: as differences of first or second order, whichever is smaller. Returns that order.
int write_column(ByteWriter& out, const std::vector<double>& values, double step);

}  // namespace gem::view
