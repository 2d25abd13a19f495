// Computes the findings of one run.
#include "gem/analysis/run_analysis.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/contact_spells.h"
#include "gem/analysis/extremes/exceedance.h"
#include "gem/analysis/orbit.h"
#include "gem/analysis/spectra/hilbert.h"
#include "gem/analysis/spectra/period.h"
#include "gem/analysis/spectra/spectral_line.h"
#include "gem/analysis/statistics/correlation.h"
#include "gem/analysis/statistics/moments.h"

namespace gem {
namespace {

constexpr std::size_t kFewestSamples = 64;
// A platform that nothing touches moves by rounding. Its spectrum has a peak too, but that is no period.
constexpr double kLeastDeviation = 1e-9;  // [m]

class Findings {
 public:
  explicit Findings(std::string prefix = "") : prefix_(std::move(prefix)) {}

  void add(const std::string& name, std::optional<double> value) { list.push_back({prefix_ + name, value, {}}); }
  void add(const std::string& name, const IntervalEstimate& estimate) {
    list.push_back({prefix_ + name, estimate.value, estimate});
  }
  void add(const std::string& name, const std::optional<PeriodEstimate>& period) {
    if (!period) return add(name, std::optional<double>{});
    add(name, IntervalEstimate{period->period, period->low, period->high});
  }

  std::vector<Finding> list;

 private:
  std::string prefix_;
};

/// Stretches of this many samples count as independent.
std::size_t independent_samples(const PlatformSeries& series) {
  const double stretch = 4.0 * series.natural_period / series.interval;
  return stretch > 0.0 ? static_cast<std::size_t>(std::llround(std::max(1.0, stretch))) : series.x.size() / 20;
}

void add_mean(Findings& findings, const std::string& name, const std::vector<double>& signal, std::size_t stretch) {
  if (signal.size() >= 4 * stretch) return findings.add(name, mean_by_effective_samples(signal, stretch));
  findings.add(name, std::optional<double>(moments(signal).mean));
}

/// Leaves out two periods at each end, which the ends of the record disturb. A record with a main period has at least
/// five.
void drop_ends(HilbertEnvelope& envelope, std::size_t samples) {
  for (std::vector<double>* column : {&envelope.amplitude, &envelope.frequency}) {
    column->erase(column->end() - static_cast<std::ptrdiff_t>(samples), column->end());
    column->erase(column->begin(), column->begin() + static_cast<std::ptrdiff_t>(samples));
  }
}

/// The envelope around the main period, and the periods of the weakest and the strongest quarter of the motion.
void add_envelope(Findings& findings, const std::vector<double>& signal, double interval,
                  const std::optional<PeriodEstimate>& main) {
  std::optional<double> middle, high, small, large;
  if (main) {
    HilbertEnvelope envelope = hilbert_envelope(signal, interval, 0.5 / main->period, 1.5 / main->period);
    drop_ends(envelope, static_cast<std::size_t>(2.0 * main->period / interval));
    middle = percentile(envelope.amplitude, 0.5);
    high = percentile(envelope.amplitude, 0.9);
    const std::vector<BackbonePoint> points = backbone(envelope, 4);
    if (points.front().frequency > 0.0) small = 1.0 / points.front().frequency;
    if (points.back().frequency > 0.0) large = 1.0 / points.back().frequency;
  }
  findings.add("amplitude_median_m", middle);
  findings.add("amplitude_p90_m", high);
  findings.add("period_of_small_amplitudes_s", small);
  findings.add("period_of_large_amplitudes_s", large);
}

void add_lines(Findings& findings, const std::vector<double>& signal, double interval) {
  const std::vector<Line> lines = find_lines(line_test(signal, interval));
  findings.add("lines", static_cast<double>(lines.size()));
  if (lines.empty()) {
    findings.add("line_period_s", std::optional<double>{});
    findings.add("line_amplitude_m", std::optional<double>{});
  } else {
    findings.add("line_period_s", std::optional<double>(1.0 / lines.front().frequency));
    findings.add("line_amplitude_m", std::optional<double>(lines.front().amplitude));
  }
}

std::vector<Finding> axis_findings(const std::string& prefix, const std::vector<double>& signal,
                                   const PlatformSeries& series) {
  Findings findings(prefix);
  add_mean(findings, "offset_m", signal, independent_samples(series));
  findings.add("deviation_m", std::optional<double>(moments(signal).deviation));
  findings.add("largest_m", std::optional<double>(maximum_excursion(signal).value));
  const bool moves = moments(signal).deviation >= kLeastDeviation;
  const auto if_moving = [moves](std::optional<PeriodEstimate> period) { return moves ? period : std::nullopt; };
  const auto main = if_moving(spectral_period(eigenspectra(signal, series.interval)));
  findings.add("period_by_spectrum_s", main);
  findings.add("period_by_crossings_s", if_moving(crossing_period(signal, series.interval)));
  findings.add("period_by_maxima_s", if_moving(maxima_period(signal, series.interval)));
  const std::vector<double> peaks = cycle_peaks(signal);
  findings.add("cycles", std::optional<double>(static_cast<double>(peaks.size())));
  findings.add("cycle_peak_p90_m", peaks.empty() ? std::nullopt : std::optional<double>(percentile(peaks, 0.9)));
  add_envelope(findings, signal, series.interval, main);
  add_lines(findings, signal, series.interval);
  return findings.list;
}

std::vector<Finding> orbit_findings(const PlatformSeries& series) {
  const Orbit path = orbit(series.x, series.y, series.interval);
  Findings findings("orbit_");
  findings.add("major_m", std::optional<double>(path.major));
  findings.add("minor_m", std::optional<double>(path.minor));
  findings.add("angle_rad", std::optional<double>(path.angle));
  findings.add("turning", std::optional<double>(path.turning));
  findings.add("largest_m", std::optional<double>(maximum_radial_excursion(series.x, series.y).value));
  return findings.list;
}

void add_lengths(Findings& findings, const std::string& name, const std::vector<Spell>& spells) {
  findings.add(name + "s", std::optional<double>(static_cast<double>(spells.size())));
  findings.add(name + "s_cut", std::optional<double>(static_cast<double>(cut_spells(spells))));
  findings.add(name + "_mean_s", spell_mean(spells));
  findings.add(name + "_median_s", spell_median(spells));
  findings.add(name + "_longest_at_least_s", longest_spell(spells));
}

std::vector<Finding> contact_findings(const PlatformSeries& series) {
  const ContactSpells spells = contact_spells(series.contacts, series.interval);
  Findings findings("contact_");
  const std::size_t stretch = independent_samples(series);
  if (series.contacts.size() >= 4 * stretch)
    findings.add("fraction",
                 contact_fraction(series.contacts, series.interval, static_cast<double>(stretch) * series.interval));
  else
    findings.add("fraction", std::optional<double>(spells.fraction));
  add_lengths(findings, "spell", spells.contact);
  add_lengths(findings, "gap", spells.gap);
  return findings.list;
}

std::vector<Finding> load_findings(const PlatformSeries& series) {
  Findings findings;
  const std::size_t stretch = independent_samples(series);
  add_mean(findings, "ice_force_x_mean_N", series.ice_force_x, stretch);
  add_mean(findings, "ice_force_y_mean_N", series.ice_force_y, stretch);
  add_mean(findings, "mooring_force_x_mean_N", series.mooring_force_x, stretch);
  add_mean(findings, "mooring_force_y_mean_N", series.mooring_force_y, stretch);
  if (!series.drag_force_x.empty()) {
    add_mean(findings, "drag_force_x_mean_N", series.drag_force_x, stretch);
    add_mean(findings, "drag_force_y_mean_N", series.drag_force_y, stretch);
  }
  const auto largest = [](const std::vector<double>& x, const std::vector<double>& y) {
    return std::optional<double>(maximum_radial_excursion(x, y).value);
  };
  findings.add("ice_force_window_largest_N", largest(series.ice_force_window_x, series.ice_force_window_y));
  findings.add("mooring_force_largest_N", largest(series.mooring_force_x, series.mooring_force_y));
  return findings.list;
}

void check(const PlatformSeries& series) {
  const std::size_t samples = series.x.size();
  for (const auto* column :
       {&series.y, &series.ice_force_x, &series.ice_force_y, &series.ice_force_window_x, &series.ice_force_window_y,
        &series.mooring_force_x, &series.mooring_force_y, &series.contacts})
    if (column->size() != samples) throw std::invalid_argument("the columns of the platform have unequal lengths");
  for (const auto* column : {&series.drag_force_x, &series.drag_force_y})
    if (column->size() != series.drag_force_x.size() || (!column->empty() && column->size() != samples))
      throw std::invalid_argument("the columns of the drag have another length than those of the platform");
  if (samples < kFewestSamples || !(series.interval > 0.0))
    throw std::invalid_argument("an analysis needs 64 samples of the platform at a positive interval");
}

}  // namespace

std::vector<Finding> analyse_platform(const PlatformSeries& series) {
  check(series);
  std::vector<Finding> all = axis_findings("x_", series.x, series);
  for (const std::vector<Finding>& part :
       {axis_findings("y_", series.y, series), orbit_findings(series), contact_findings(series), load_findings(series)})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

bool is_resolved(const Finding& finding) {
  if (!finding.value) return false;
  if (!finding.name.ends_with("_period_by_spectrum_s")) return true;
  return finding.interval && finding.interval->high <= 2.0 * finding.interval->low;
}

Finding finding_of(const std::vector<Finding>& findings, const std::string& name) {
  const auto found =
      std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) { return finding.name == name; });
  return found == findings.end() ? Finding{name, {}, {}} : *found;
}

}  // namespace gem
