// The tables of a run report as HTML.
#pragma once

#include <string>

#include "gem/report/run_data.h"
#include "gem/report/run_summary.h"

namespace gem {

std::string headline_html(const RunData& run, const RunSummary& summary);
std::string identity_html(const RunData& run);
std::string motion_html(const RunData& run, const RunSummary& summary);
std::string loads_html(const RunData& run, const RunSummary& summary);
std::string quality_html(const RunData& run, const RunSummary& summary);

}  // namespace gem
