// Twins of the paper's figures 7 to 20, and what they do not show: envelope, exceedance, growth of the maximum,
// divergence.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/paper/runs/paper_run.h"
#include "validation/paper/statements/catalogue.h"
#include "validation/paper/studies/divergence_study.h"
#include "validation/paper/studies/ice_study.h"
#include "validation/paper/studies/unordered_study.h"

namespace gem {

/// A drawn figure: which of the paper's it is the twin of, and where the picture is.
struct PaperFigure {
  std::string number;  // "7", "17", or "-" for an extra
  std::string title;
  std::filesystem::path path;  // without .svg
};

/// Figures 7 to 11 and 13 to 16 from the first run of 004_400_25 and of 400_300_100 that has its run file.
std::vector<PaperFigure> twin_figures(const PaperFolder& folder, const std::filesystem::path& out);

/// Figure 12: x of run 1, of its repetition, and of a run that differs by the place of one floe; and, where there are
/// pairs, their distance against time.
std::vector<PaperFigure> repeat_figures(const PaperFolder& folder, const DivergenceStudy& study,
                                        const std::filesystem::path& out);

/// Distance of the ice against time of runs that differ by the place of one floe, a picture for each kind of contacts.
std::vector<PaperFigure> ice_figures(const IceStudy& study, const std::filesystem::path& out);

/// Distance against time of repeats whose sums are taken in no fixed order, beside that of runs with a floe moved.
std::vector<PaperFigure> unordered_figures(const UnorderedStudy& study, const std::filesystem::path& out);

/// Figures 17 to 20: largest excursion against current, one line per gap, the mean over the seeds with
/// its 95 % interval and, thin, from the smallest to the largest seed.
std::vector<PaperFigure> excursion_figures(const PaperFolder& folder, const std::vector<TableRow>& rows,
                                           const std::filesystem::path& out);

/// Of run 1: amplitude over time, of the first run that has its run file; exceedance of the peaks of all seeds.
std::vector<PaperFigure> extra_figures(const PaperFolder& folder, const std::filesystem::path& out);

/// Of run 1 over its seeds: swing and offset over time, largest excursion against duration. And the swing of the
/// runs of cases/day.toml.
std::vector<PaperFigure> seed_figures(const PaperFolder& folder, const std::filesystem::path& out);

/// "004_400_25: coupled, dt 0.1 s, seed 1  gem 0.1.0 (commit)": printed on every figure; the name says ice, gap,
/// current.
std::string conditions_text(const PaperRun& run);

}  // namespace gem
