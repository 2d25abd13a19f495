// Counterparts of the paper's figures 7 to 20, and further figures: envelope, exceedance, growth of the maximum,
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

/// A drawn figure: the figure of the paper that it corresponds to, and the picture.
struct PaperFigure {
  std::string number;  // "7", "17", or "-" for an extra
  std::string title;
  std::filesystem::path path;  // without .svg
};

/// Figures 7 to 11 and 13 to 16, from the first run of 004_400_25 and of 400_300_100 that has its run file.
std::vector<PaperFigure> twin_figures(const PaperFolder& folder, const std::filesystem::path& out);

/// Figure 12: x of run 1, of its repetition, and of a run in which one floe is shifted. With pairs of runs also their
/// distance against time.
std::vector<PaperFigure> repeat_figures(const PaperFolder& folder, const DivergenceStudy& study,
                                        const std::filesystem::path& out);

/// Distance of the ice against time for runs in which one floe is shifted, one picture for each kind of contacts.
std::vector<PaperFigure> ice_figures(const IceStudy& study, const std::filesystem::path& out);

/// Distance against time of repeats with sums without a fixed order, beside that of runs in which a floe is shifted.
std::vector<PaperFigure> unordered_figures(const UnorderedStudy& study, const std::filesystem::path& out);

/// Figures 17 to 20: largest excursion against current, one line per gap: the mean over the seeds with its 95 %
/// interval and, thin, the range from the smallest to the largest seed.
std::vector<PaperFigure> excursion_figures(const PaperFolder& folder, const std::vector<TableRow>& rows,
                                           const std::filesystem::path& out);

/// Of run 1: amplitude over time, from the first run that has its run file, and exceedance of the peaks of all seeds.
std::vector<PaperFigure> extra_figures(const PaperFolder& folder, const std::filesystem::path& out);

/// Of run 1 over its seeds: swing and offset over time, and largest excursion against duration. Also the swing of the
/// runs of cases/day.toml.
std::vector<PaperFigure> seed_figures(const PaperFolder& folder, const std::filesystem::path& out);

/// "004_400_25: coupled, dt 0.1 s, seed 1  gem 0.1.0 (commit)", printed on every figure. The name gives ice, gap and
/// current.
/// current.
std::string conditions_text(const PaperRun& run);

}  // namespace gem
