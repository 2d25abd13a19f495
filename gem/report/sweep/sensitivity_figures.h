// Pictures of a sensitivity study.
#pragma once

#include <vector>

#include "gem/report/figures/plot_folder.h"
#include "gem/report/sweep/sensitivity_page.h"

namespace gem {

/// For one condition: the shares of all outputs as bars, then each output against each input.
std::vector<Figure> sensitivity_figures(const SensitivityPage& page, std::size_t condition, const PlotFolder& folder);

}  // namespace gem
