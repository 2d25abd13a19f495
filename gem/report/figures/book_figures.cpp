// Figures of the books: unexplained momentum and energy, and overlap.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "gem/analysis/statistics/moments.h"
#include "gem/report/display.h"
#include "gem/report/figures/figures.h"
#include "gem/report/figures/series.h"

namespace gem {
namespace {

/// A logarithmic axis has no zero, so a residual of zero is drawn just below rounding.
double drawable(double residual) { return std::max(std::abs(residual), 1e-18); }

}  // namespace

std::vector<Figure> book_figures(const RunData& run, const PlotFolder& folder) {
  const StatsRecord& s = run.stats;
  if (s.time.size() < 2) return {};
  const Unit time = time_unit(run.duration_s);
  const Unit length = length_unit(std::abs(maximum_excursion(s.maximum_overlap).value));
  Csv csv("t [" + time.name + "],momentum,angular momentum,energy,overlap [" + length.name + "]");
  for (const std::size_t i : envelope(s.maximum_overlap, 2000))
    csv.row({s.time[i] / time.size, drawable(s.residual_momentum[i]), drawable(s.residual_angular_momentum[i]),
             drawable(s.residual_energy[i]), s.maximum_overlap[i] / length.size});
  folder.write_csv("books", csv);
  std::ostringstream commands;
  commands << "set multiplot layout 2,1\nset xlabel 'time [" << time.name
           << "]' offset 0,0.4\nset xrange [0:" << rounded_text(run.duration_s / time.size, 6) << "]\n"
           << "set termoption enhanced\nset logscale y\nset format y '10^{%L}'\nset ylabel 'residual, relative'\n"
           << "set yrange [1e-18:*]\n"
           << "plot 'books.csv' using 1:2 with points linestyle 1 pt 7 ps 0.35 title 'momentum', '' using 1:3 with "
              "points linestyle 3 pt 7 ps 0.35 title 'angular momentum', '' using 1:4 with points linestyle 2 pt 7 ps "
              "0.35 title 'energy'\n"
           << "unset label 99\nunset logscale y\nset format y '%g'\nset yrange [0:*]\nset ylabel 'deepest overlap ["
           << length.name << "]'\nplot 'books.csv' using 1:5 with points linestyle 1 pt 7 ps 0.35\nunset multiplot\n";
  return {
      folder.draw({"books", "Residuals of the ledger and deepest overlap",
                   "Above: what the ledger of momentum, angular momentum and energy leaves unexplained, relative to "
                   "the largest amounts in the run; nothing at all is drawn at 10<sup>-18</sup>. Below: the deepest "
                   "overlap of any two bodies. Each point is one look at the books.",
                   ""},
                  {1000, 520}, commands.str())};
}

}  // namespace gem
