// The figures of single runs, drawn by the run report.
#include "gem/base/number_text.h"
#include "gem/report/figures/figures.h"
#include "gem/report/run/load_run.h"
#include "validation/paper/plots/paper_figures.h"

namespace gem {
namespace {

struct Twin {
  std::string number;
  std::string figure;  // its name in the run report
};

std::vector<PaperFigure> draw_run(const PaperRun& run, const std::string& field_number, const std::vector<Twin>& twins,
                                  const std::filesystem::path& out) {
  const RunData data = load_run(run.file, false);
  const std::filesystem::path place = out / run.condition;
  const PlotFolder plots(place, conditions_text(run));
  std::vector<Figure> drawn = motion_figures(data, run_findings(data), plots);
  for (Figure& figure : force_figures(data, plots)) drawn.push_back(std::move(figure));
  std::vector<PaperFigure> figures;
  if (data.frames.size() == 3) {
    const Figure field = field_figure(data, "field", "The field at the middle of " + run.condition, plots);
    figures.push_back({field_number, field.title, place / field.name});
  }
  for (const Figure& figure : drawn)
    for (const Twin& twin : twins)
      if (figure.name == twin.figure)
        figures.push_back({twin.number, figure.title + ", " + run.condition, place / figure.name});
  return figures;
}

}  // namespace

std::string conditions_text(const PaperRun& run) {
  return run.scene.run.name + ": " + run.resolution + ", dt " + number_text(run.scene.numerics.time_step_s, 3) +
         " s, seed " + std::to_string(run.seed) + "  " + run.source;
}

std::vector<PaperFigure> twin_figures(const PaperFolder& folder, const std::filesystem::path& out) {
  std::vector<PaperFigure> figures;
  const auto append = [&](const std::string& condition, const std::string& field, const std::vector<Twin>& twins) {
    const PaperRun* run = folder.with_file(condition);
    if (run == nullptr) return;
    for (PaperFigure& figure : draw_run(*run, field, twins, out)) figures.push_back(std::move(figure));
  };
  append("004_400_25", "7",
         {{"9", "motion_x"},
          {"10", "motion_y"},
          {"11", "orbit"},
          {"15", "ice_force"},
          {"16", "ice_and_mooring"},
          {"-", "spectrum"}});
  append("400_300_100", "8", {{"13", "motion_x"}, {"14", "orbit"}, {"-", "spectrum"}});
  return figures;
}

}  // namespace gem
