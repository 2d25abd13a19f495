// The platform's record of a run in the form that the analysis takes.
#pragma once

#include <cstddef>

#include "gem/analysis/run_analysis.h"
#include "gem/report/run_data.h"

namespace gem {

/// From sample `first` on, motion measured from rest. Throws Error(file_system) for uneven samples.
PlatformSeries platform_series(const RunData& run, std::size_t first = 0);

}  // namespace gem
