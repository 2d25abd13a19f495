// Makes one run of the regression table and takes its numbers.
#pragma once

#include <cstdint>

#include "gem/engine/engine.h"
#include "validation/regression/run_list.h"
#include "validation/regression/table.h"

namespace gem::regression {

/// A run that was made.
struct MeasuredRun {
  Row row;
  std::int64_t contacts = 0;           // touching points, summed over the steps
  std::int64_t platform_contacts = 0;  // contacts of the platform that carried an impulse, summed over the steps
};

/// Moves the run to its end on the named engine. Every number is the same on every engine with the same bits.
/// Throws gem::Error if the case is refused or the run stops.
MeasuredRun measured(const ListedRun& run, const EngineOptions& options);

}  // namespace gem::regression
