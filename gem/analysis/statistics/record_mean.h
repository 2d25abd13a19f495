// Mean of one correlated record, with its interval.
#pragma once

#include <string>
#include <vector>

#include "gem/analysis/run_analysis.h"

namespace gem {

/// Stretches of a twentieth of the record count as independent; a record of fewer than forty values has no interval.
Finding mean_of(const std::string& name, const std::vector<double>& record);

}  // namespace gem
