// The platform's record of a run in the form that the analysis needs.
#pragma once

#include <cstddef>

#include "gem/analysis/run_analysis.h"
#include "gem/report/run/run_data.h"

namespace gem {

/// Index of the first sample at or after a time [s]; the number of samples if there is none.
std::size_t sample_from(const RunData& run, double from_s);

/// The record from sample `first` on, motion measured from rest. Throws Error(file_system) if the samples are not
/// evenly spaced.
PlatformSeries platform_series(const RunData& run, std::size_t first = 0);

}  // namespace gem
