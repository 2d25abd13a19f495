// Sections on many seeds of one condition.
#include <sstream>

#include "gem/report/display.h"
#include "validation/paper/page/page_parts.h"

namespace gem {
namespace {

std::string interval_text(const IntervalEstimate& estimate, double unit) {
  return rounded_text(estimate.value / unit, 3) + " (" + rounded_text(estimate.low / unit, 3) + " … " +
         rounded_text(estimate.high / unit, 3) + ")";
}

std::string interval_text(const std::optional<IntervalEstimate>& estimate, double unit) {
  return estimate ? interval_text(*estimate, unit) : "-";
}

constexpr double kMillimetre = 1e-3;

}  // namespace

std::string stationarity_text(const Reproduction& result) {
  std::ostringstream text;
  text << "## Is the motion stationary?\n\n";
  if (result.stationarity.empty()) return text.str() + "Needs several seeds of a condition.\n\n";
  text << "Second half of every run against its first, over the seeds (95 % over them: Student's t of fewer "
          "than ten, of the ratios by their logarithms; the bootstrap from ten on). Swing: deviation of x within "
          "stretches of 600 s. A run grows or shrinks if the interval of the ratio leaves out 1; fewer than four seeds "
          "decide nothing.\n\n"
       << "| run | seeds | half [s] | swing of x, first half [mm] | second half [mm] | ratio of x | ratio of y | mean "
          "of x, shift [mm] | |\n|---|---:|---:|---|---|---|---|---|---|\n";
  for (const StationarityRow& row : result.stationarity)
    text << "| " << row.condition << " | " << row.seeds << " | " << rounded_text(row.half_s, 5) << " | "
         << interval_text(row.early_swing_m, kMillimetre) << " | " << interval_text(row.late_swing_m, kMillimetre)
         << " | " << interval_text(row.ratio_x, 1.0) << " | " << interval_text(row.ratio_y, 1.0) << " | "
         << interval_text(row.offset_shift_m, kMillimetre) << " | " << growth_text(row.growth) << " |\n";
  return text.str() + "\n";
}

std::string extremes_text(const Reproduction& result) {
  std::ostringstream text;
  text << "## The largest excursion of a run\n\n";
  if (result.extremes.empty()) return text.str() + "Needs five seeds of a condition.\n\n";
  text << "Exposure: the duration of the run. p90: what nine runs of ten stay below, with its 95 % interval; by "
          "Gumbel's law of the largest of each run, of the largest of each 600 s (which takes these as independent and "
          "the motion as stationary: where it is not, this differs), and by ACER (k = 2) of all peaks, one per natural "
          "period (- "
          "where they do not resolve its tail).\n\n"
       << "| run | seeds | mean [mm] | p90, runs [mm] | p90, 600 s [mm] | p90, ACER [mm] | p90 of the ice force, 1 s "
          "[kN] |\n|---|---:|---|---|---|---|---|\n";
  for (const ExtremesRow& row : result.extremes)
    text << "| " << row.condition << " | " << row.seeds << " | " << interval_text(row.mean_m, kMillimetre) << " | "
         << interval_text(row.p90_m, kMillimetre) << " | " << interval_text(row.by_block_m, kMillimetre) << " | "
         << interval_text(row.by_acer_m, kMillimetre) << " | " << interval_text(row.force_p90_N, 1e3) << " |\n";
  return text.str() + "\n";
}

std::string days_text(const PaperFolder& folder, const Reproduction& result) {
  std::ostringstream text;
  text << "## What a day shows\n\n";
  if (result.days.empty()) return text.str() + "Needs runs of `cases/day.toml`.\n\n";
  text << "One run each (`cases/day.toml`), beside the runs of the same condition in Table 1 (mean over the seeds; "
          "their "
          "mean of x counts the minutes before the ice comes and after it has passed). Swing: deviation of x within "
          "stretches of 600 s, root mean square over an hour; 95 % over the hours of that part, taken as independent "
          "(of "
          "the first two, Student's t of two).\n\n"
       << "| run | swing, first 2 h [mm] | half of the rest [mm] | other half [mm] | mean of x after 2 h [mm] | in "
          "Table 1 "
          "[mm] | period of x [s] | in Table 1 [s] | largest excursion of the day [mm] | in Table 1 [mm] |\n"
          "|---|---|---|---|---|---|---|---|---:|---|\n";
  for (const DayRow& row : result.days)
    text << "| " << row.day << " (" << rounded_text(row.hours, 3) << " h) | " << interval_text(row.first, kMillimetre)
         << " | " << interval_text(row.middle, kMillimetre) << " | " << interval_text(row.last, kMillimetre) << " | "
         << interval_text(row.mean_x, kMillimetre) << " | "
         << mean_text(folder, row.condition, "x_offset_m", kMillimetre) << " | "
         << mean_text(folder, row.day, "x_period_by_spectrum_s") << " | "
         << mean_text(folder, row.condition, "x_period_by_spectrum_s") << " | "
         << rounded_text(row.largest_excursion / kMillimetre, 3) << " | "
         << mean_text(folder, row.condition, "orbit_largest_m", kMillimetre) << " |\n";
  return text.str() + "\n";
}

}  // namespace gem
