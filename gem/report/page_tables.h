// The tables of a run report as HTML.
#pragma once

#include <string>
#include <vector>

#include "gem/report/run/run_data.h"
#include "gem/report/run/run_findings.h"

namespace gem {

std::string headline_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis);
std::string identity_html(const RunData& run);
std::string motion_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis);
std::string loads_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis);
/// Nothing if the run did not record loads by side. Of an outline with many sides, the dozen that took most.
std::string sides_html(const RunData& run);
/// Nothing for a run without mooring lines.
std::string lines_html(const RunData& run);
/// Nothing without the forces on [[fixed]] bodies at two frames.
std::string fixed_html(const RunData& run);
/// Nothing without thrusters.
std::string dp_html(const RunData& run);
std::string verdict_html(const RunVerdict& verdict);
std::string quality_html(const RunData& run, const RunFindings& findings);

}  // namespace gem
