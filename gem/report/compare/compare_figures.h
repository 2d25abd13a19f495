// Records of several runs in one picture each.
#pragma once

#include <vector>

#include "gem/report/compare/comparison.h"
#include "gem/report/figures/plot_folder.h"

namespace gem {

/// Ice force, how often it is exceeded, x(t), y(t) and the spectrum of x, each with one curve per run.
std::vector<Figure> compare_figures(const std::vector<ComparedRun>& runs, const PlotFolder& folder);

/// The colour of a run in figures and tables, "#rrggbb".
const char* run_colour(std::size_t run);

}  // namespace gem
