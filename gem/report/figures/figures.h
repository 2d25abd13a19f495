// The figures of a run report. Each writes its data and script into the folder and returns the picture.
#pragma once

#include <string>
#include <vector>

#include "gem/report/figures/plot_folder.h"
#include "gem/report/run/run_data.h"
#include "gem/report/run/run_findings.h"

namespace gem {

/// The whole channel at the start, at run.at_s (else the middle) and at the end, coloured by speed, and the area around
/// the platform at the second time.
std::vector<Figure> field_figures(const RunData& run, const PlotFolder& folder);

/// The whole channel at the middle of the run, as a figure of the given name. Needs the three frames of a run.
Figure field_figure(const RunData& run, const std::string& name, const std::string& title, const PlotFolder& folder);

/// The ice around the platform in the second frame, small and without axes. Needs the three frames of a run.
Figure small_field_figure(const RunData& run, const std::string& name, const std::string& title,
                          const PlotFolder& folder);

/// x(t), y(t), the orbit and the spectra of both.
std::vector<Figure> motion_figures(const RunData& run, const RunFindings& findings, const PlotFolder& folder);

/// Net ice force with an extract (force_window.h), ice against mooring force, and what else drives or holds the
/// platform; forces on fixed bodies.
std::vector<Figure> force_figures(const RunData& run, const PlotFolder& folder);

/// Offset, yaw error and used thrust of dynamic positioning; none without thrusters.
std::vector<Figure> dp_figures(const RunData& run, const PlotFolder& folder);

/// Resistance and side force of the ice along the path; none without transit.
std::vector<Figure> transit_figures(const RunData& run, const PlotFolder& folder);

/// Force of the ice on fixed bodies; none without forces on [[fixed]] bodies at ten frames, and none where no ice came.
std::vector<Figure> fixed_figures(const RunData& run, const PlotFolder& folder);

/// Residuals of the books, and overlap, against time.
std::vector<Figure> book_figures(const RunData& run, const PlotFolder& folder);

}  // namespace gem
