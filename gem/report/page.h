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

/// Self-contained HTML: style and pictures inline, nothing loaded from elsewhere.
std::string page_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis,
                      const PageFigures& figures);

/// What the page of a run is called, as it stands in its head.
std::string page_title(const std::string& run);

/// Text made safe for HTML.
std::string escaped(const std::string& text);

}  // namespace gem
