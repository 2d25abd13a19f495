// The page of a run report: one HTML file with everything in it.
#pragma once

#include <string>
#include <vector>

#include "gem/report/figures/plot_folder.h"
#include "gem/report/run/run_data.h"
#include "gem/report/run/run_findings.h"

namespace gem {

struct PageFigures {
  std::vector<Figure> field, motion, force, books;
};

/// A self-contained page: style and pictures are inline, nothing is loaded from elsewhere.
std::string page_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis,
                      const PageFigures& figures);

/// Title of the page of a run.
std::string page_title(const std::string& run);

}  // namespace gem
