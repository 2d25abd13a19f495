// All criteria together.
#pragma once

#include "gem/analysis/verdict/run_measures.h"
#include "gem/record/verdict.h"

namespace gem {

/// The worst grade of the criteria that could be judged; not_judged if none could.
RunVerdict judge_run(const RunMeasures& run);

/// A run that stopped by itself because its numbers had failed (`why`) is bad, whatever the other criteria say.
RunVerdict judge_stopped_run(const RunMeasures& run, const std::string& why);

}  // namespace gem
