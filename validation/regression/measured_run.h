// Makes one run of the regression table and takes its numbers.
#pragma once

#include <cstdint>

#include "gem/engine/engine.h"
#include "validation/regression/run_list.h"
#include "validation/regression/table.h"

namespace gem::regression {

/// The results of a run.
struct MeasuredRun {
  Row row;
  std::int64_t contacts = 0;           // contact points, summed over the steps
  std::int64_t platform_contacts = 0;  // contacts of the platform with an impulse, summed over the steps
};

/// Runs to the end on the named engine. All numbers are equal on engines with the same bits. Throws gem::Error if the
/// case is refused or the run stops.
MeasuredRun measured(const ListedRun& run, const EngineOptions& options);

}  // namespace gem::regression
