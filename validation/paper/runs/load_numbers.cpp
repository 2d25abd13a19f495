// Ratios of loads, and the energy that the ice adds to or takes from the motion.
#include <cmath>

#include "gem/analysis/statistics/moments.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {
namespace {

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const Moments of_a = moments(a);
  const Moments of_b = moments(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - of_a.mean) * (b[i] - of_b.mean);
  return sum / (static_cast<double>(a.size()) * of_a.deviation * of_b.deviation);
}

/// Work of the ice on the platform, sample by sample: the part added and the part removed.
void add_work(const PlatformSeries& series, Numbers& numbers) {
  double put_in = 0.0;
  double taken = 0.0;
  for (std::size_t i = 1; i < series.x.size(); ++i) {
    const double work = series.ice_force_x[i] * (series.x[i] - series.x[i - 1]) +
                        series.ice_force_y[i] * (series.y[i] - series.y[i - 1]);
    (work > 0.0 ? put_in : taken) += std::abs(work);
  }
  numbers.add("ice_work_in_J", put_in);
  numbers.add("ice_work_out_J", taken);
  numbers.add("ice_work_lesser_share", std::min(put_in, taken) / std::max(put_in, taken));
}

}  // namespace

void add_load_numbers(const NumberSource& source, Numbers& numbers) {
  const PlatformSeries& series = source.series;
  const PlatformLoads& loads = source.loads;
  if (loads.events == 0 && loads.contact_fraction == 0.0) return;
  const double mean = std::hypot(loads.ice_mean_x, loads.ice_mean_y);
  const double sample_peak = loads.sample_impulse_largest / loads.sample_s;
  numbers.add("ice_mean_N", mean);
  numbers.add("ice_peak_sample_N", sample_peak);
  numbers.add("ice_peak_window_N", loads.ice_window_largest);
  numbers.add("ice_peak_crushing_N", loads.crushing_largest);
  numbers.add("mooring_peak_N", loads.mooring_largest);
  numbers.add("ice_sample_over_mooring", sample_peak / loads.mooring_largest);
  numbers.add("ice_window_over_mooring", loads.ice_window_largest / loads.mooring_largest);
  numbers.add("ice_crushing_over_mooring", loads.crushing_largest / loads.mooring_largest);
  numbers.add("mooring_over_ice_mean", loads.mooring_largest / mean);
  numbers.add("platform_events", static_cast<double>(loads.events));
  numbers.add("platform_touches", static_cast<double>(loads.touches));
  numbers.add("platform_arrivals", static_cast<double>(loads.arrivals));
  numbers.add("ice_mooring_likeness", std::abs(correlation(series.ice_force_window_x, series.mooring_force_x)));
  numbers.add("x_y_likeness", std::abs(correlation(series.x, series.y)));
  add_work(series, numbers);
}

}  // namespace gem
