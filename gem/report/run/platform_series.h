// The platform's record of a run as the analysis takes it.
#pragma once

#include <cstddef>

#include "gem/analysis/run_analysis.h"
#include "gem/report/run/run_data.h"

namespace gem {

/// The first sample at or after a time [s]; the number of samples if there is none.
std::size_t sample_from(const RunData& run, double from_s);

/// The record from a sample on, motion measured from rest. Throws Error(file_system) if the samples are not even.
PlatformSeries platform_series(const RunData& run, std::size_t first = 0);

}  // namespace gem
