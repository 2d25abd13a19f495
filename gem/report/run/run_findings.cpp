// Computes the numbers of a report from the records of a run.
#include "gem/report/run/run_findings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "gem/analysis/spectra/spectrum.h"
#include "gem/base/error.h"
#include "gem/report/run/platform_series.h"

namespace gem {
namespace {

std::vector<double> from_rest(const std::vector<double>& position, double rest) {
  std::vector<double> result = position;
  for (double& value : result) value -= rest;
  return result;
}

AxisMotion axis_motion(const RunData& run, const std::vector<double>& position, double rest) {
  const std::vector<double> motion = from_rest(position, rest);
  AxisMotion axis;
  axis.deviation = moments(motion).deviation;
  const Excursion largest = maximum_excursion(motion);
  axis.excursion = largest.value;
  axis.excursion_time = run.platform.time[largest.sample];
  if (motion.size() < kSamplesForStatistics) return axis;
  const double interval = sample_interval(run.platform.time);
  const std::vector<Spectrum> spectra = eigenspectra(motion, interval);
  axis.spectral = spectral_period(spectra);
  axis.spectrum = mean_spectrum(spectra);
  return axis;
}

/// The largest length of a force in the plane. Sets where it acted if there is any.
double largest_force(const std::vector<double>& time, const std::vector<double>& x, const std::vector<double>& y,
                     ForceAt& at) {
  const Excursion largest = maximum_radial_excursion(x, y);
  if (!time.empty()) at = {time[largest.sample], std::atan2(y[largest.sample], x[largest.sample])};
  return largest.value;
}

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// NaN if the engine does not measure it.
double largest_measured(const std::vector<double>& values) {
  const bool measured = std::none_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
  return measured ? largest_of(values) : std::numeric_limits<double>::quiet_NaN();
}

PlatformLoads loads(const RunData& run) {
  const PlatformRecord& p = run.platform;
  PlatformLoads result;
  result.contact_fraction = intermittency(p.contacts);
  result.ice_window_largest = largest_force(p.time, p.ice_force_mean_x, p.ice_force_mean_y, result.ice_window_at);
  result.mooring_largest = largest_force(p.time, p.mooring_force_x, p.mooring_force_y, result.mooring_at);
  if (p.time.size() >= kSamplesForStatistics) {
    result.sample_s = sample_interval(p.time);
    result.sample_impulse_largest =
        largest_force(p.time, p.ice_force_x, p.ice_force_y, result.ice_sample_at) * result.sample_s;
    result.ice_mean_x = moments(p.ice_force_x).mean;
    result.ice_mean_y = moments(p.ice_force_y).mean;
  }
  result.events = run.events.time.size();
  result.arrivals = std::set<std::int32_t>(run.events.body_b.begin(), run.events.body_b.end()).size();
  result.event_impulse_largest = largest_of(run.events.impulse);
  result.touches = opening_events(run.events).size();
  result.crushing_largest = largest_of(run.events.force_peak);
  result.crushing_median = percentile(run.events.force_peak, 0.5);
  return result;
}

RunQuality quality(const StatsRecord& stats) {
  RunQuality result;
  result.residual_momentum = largest_of(stats.residual_momentum);
  result.residual_angular_momentum = largest_of(stats.residual_angular_momentum);
  result.residual_energy = largest_of(stats.residual_energy);
  result.maximum_overlap = largest_of(stats.maximum_overlap);
  result.most_overlap = std::min(stats.overlap.quantile(0.999), result.maximum_overlap);
  result.maximum_share = largest_of(stats.maximum_overlap_share);
  result.most_share = std::min(stats.overlap_share.quantile(0.999), result.maximum_share);
  result.complementarity = largest_measured(stats.complementarity);
  result.cone_excess = largest_measured(stats.cone_excess);
  result.energy_created = largest_measured(stats.energy_created);
  if (!stats.time.empty() && stats.wall_time.back() > 0.0) result.speed = stats.time.back() / stats.wall_time.back();
  return result;
}

/// Left out where nothing can pull, and for a ship on its way: transit_findings() says what its thrust or its tow
/// gives.
void leave_out_mooring(const RunData& run, std::vector<Finding>& findings) {
  if (run.is_held && !run.transit.present) return;
  std::erase_if(findings, [](const Finding& finding) { return finding.name.starts_with("mooring_"); });
}

/// What only some runs have: thrusters, transit, fixed bodies.
void add_special(const RunData& run, std::size_t first, std::vector<Finding>& findings) {
  const double from_s = run.platform.time.at(first);
  for (const std::vector<Finding>& part :
       {dp_findings(run.dp, first), transit_findings(run.transit, first), fixed_findings(run.on_fixed, from_s)})
    findings.insert(findings.end(), part.begin(), part.end());
}

}  // namespace

bool is_of_swing(const Finding& finding) {
  return finding.name.starts_with("x_") || finding.name.starts_with("y_") || finding.name.starts_with("orbit_");
}

double sample_interval(const std::vector<double>& time) {
  const double interval = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t i = 0; i < time.size(); ++i)
    if (!(std::abs(time[i] - time.front() - static_cast<double>(i) * interval) <= 1e-6 * time.back()))
      throw Error(
          ExitCode::file_system,
          "the platform record has uneven samples (output.platform_interval_s is not a whole number of time steps, "
          "or the file is damaged); run the case with another interval");
  return interval;
}

std::vector<std::size_t> opening_events(const EventColumns& events) {
  std::map<std::int32_t, double> last;
  std::vector<std::size_t> opening;
  for (std::size_t i = 0; i < events.time.size(); ++i) {
    const auto [entry, first] = last.try_emplace(events.body_b[i], events.time[i]);
    if (first || events.time[i] - entry->second >= kTouchGap) opening.push_back(i);
    entry->second = events.time[i];
  }
  return opening;
}

bool without_contact(const RunData& run, const PlatformLoads& loads) {
  return run.events.time.empty() && loads.contact_fraction == 0.0 && loads.ice_window_largest == 0.0;
}

RunFindings run_findings(const RunData& run) {
  RunFindings findings;
  findings.quality = quality(run.stats);
  if (run.platform.time.empty()) return findings;
  findings.x = axis_motion(run, run.platform.x, run.rest.x);
  findings.y = axis_motion(run, run.platform.y, run.rest.y);
  const Excursion radial = maximum_radial_excursion(run.platform.x, run.platform.y, run.rest.x, run.rest.y);
  findings.radial_excursion = radial.value;
  findings.radial_time = run.platform.time[radial.sample];
  findings.loads = loads(run);
  return findings;
}

std::vector<Finding> platform_findings(const RunData& run, std::size_t first) {
  std::vector<Finding> findings = analyse_platform(platform_series(run, first));
  if (run.transit.present) std::erase_if(findings, is_of_swing);
  leave_out_mooring(run, findings);
  add_special(run, first, findings);
  return findings;
}

std::vector<Finding> whole_run_analysis(const RunData& run) {
  if (run.platform.time.size() < kSamplesForStatistics) return {};
  std::vector<Finding> findings = analyse_platform(platform_series(run));
  leave_out_mooring(run, findings);
  add_special(run, 0, findings);
  return findings;
}

}  // namespace gem
