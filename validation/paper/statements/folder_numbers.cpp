// Trends, totals, repetition and tail from the runs of both tables.
#include "validation/paper/statements/folder_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/moments.h"
#include "gem/analysis/statistics/proportion.h"
#include "validation/paper/analysis/extremes/peaks_over_threshold.h"
#include "validation/paper/analysis/fits/linear_model.h"
#include "validation/paper/statements/settings_check.h"

namespace gem {
namespace {

constexpr const char* kRunOne = "004_400_25";
constexpr const char* kRunOneAgain = "004_400_25(2)";
constexpr double kDay = 86400.0;
constexpr double kSecond = 1.0;

Measured exact(double value, const std::string& what) { return {value, value, value, what}; }

Measured from(const IntervalEstimate& estimate, const std::string& what) {
  return {estimate.value, estimate.low, estimate.high, what};
}

std::set<std::string> names_of(const std::vector<TableRow>& rows) {
  std::set<std::string> names;
  for (const TableRow& row : rows) names.insert(row.run);
  return names;
}

/// Uses one seed of each run of the tables, because the paper ran each once. A total needs all of them.
void add_totals(const PaperFolder& folder, const std::set<std::string>& names, FolderNumbers& numbers) {
  double simulated = 0.0;
  double wall = 0.0;
  double best = 0.0;
  for (const std::string& name : names) {
    if (folder.of(name).empty()) return;
    const Numbers& first = folder.of(name).front().numbers;
    const auto duration = first.find("duration_s");
    const auto own_wall = first.find("wall_s");
    const auto factor = first.find("real_time_factor");
    if (!duration || !own_wall || !factor) return;
    simulated += duration->value;
    wall += own_wall->value;
    best = std::max(best, factor->value);
  }
  const std::string what = std::to_string(names.size()) + " runs";
  numbers["simulated_h"] = exact(simulated / 3600.0, what);
  numbers["real_time_factor_mean"] = exact(simulated / wall, what);
  numbers["real_time_factor_best"] = exact(best, what);
}

void add_trend(const std::vector<ExcursionPoint>& points, FolderNumbers& numbers) {
  std::vector<std::vector<double>> columns(3);
  std::vector<double> excursion, seeds;
  for (const ExcursionPoint& point : points) {
    if (point.mixed) continue;
    columns[0].push_back(std::log(point.thickness_m));
    columns[1].push_back(std::log(point.gap_m));
    columns[2].push_back(std::log(point.current_m_per_s));
    excursion.push_back(std::log(point.mean()));
    std::vector<double> logs;
    for (const double value : point.largest_m) logs.push_back(std::log(value));
    const auto count = static_cast<double>(logs.size());
    if (logs.size() > 1) seeds.push_back(moments(logs).deviation * std::sqrt(count / (count - 1.0)));
  }
  try {
    const LinearModel model = fit_linear_model(columns, excursion);
    const std::string what = "95 % over " + std::to_string(excursion.size()) + " conditions";
    numbers["excursion_exponent_thickness"] = from(model.slopes[0], what);
    numbers["excursion_exponent_gap"] = from(model.slopes[1], what);
    numbers["excursion_exponent_current"] = from(model.slopes[2], what);
    numbers["excursion_scatter"] = exact(model.scatter, std::to_string(excursion.size()) + " conditions");
  } catch (const std::invalid_argument&) {
    // Too few conditions to separate the three exponents, so no trend is stated.
  }
  if (seeds.size() > 1)
    numbers["excursion_scatter_of_seeds"] =
        from(mean_of_runs(seeds), "95 % over " + std::to_string(seeds.size()) + " conditions");
}

/// Pairs of conditions that differ in one property and agree in the others.
template <typename Property, typename Others>
void add_share(const std::vector<ExcursionPoint>& points, const std::string& name, Property more, Others same,
               FolderNumbers& numbers) {
  std::size_t larger = 0, pairs = 0;
  for (const ExcursionPoint& a : points)
    for (const ExcursionPoint& b : points) {
      if (a.mixed || b.mixed || !same(a, b) || !more(b, a)) continue;
      ++pairs;
      larger += b.mean() > a.mean() ? 1U : 0U;
    }
  if (pairs < kRunsForShare) return;
  numbers[name] = from(wilson_share(larger, pairs), "Wilson's 95 % over " + std::to_string(pairs) + " pairs");
}

void add_shares(const std::vector<ExcursionPoint>& points, FolderNumbers& numbers) {
  using P = ExcursionPoint;
  add_share(
      points, "thicker_is_larger_share", [](const P& b, const P& a) { return b.thickness_m > a.thickness_m; },
      [](const P& a, const P& b) { return a.gap_m == b.gap_m && a.current_m_per_s == b.current_m_per_s; }, numbers);
  add_share(
      points, "narrower_is_larger_share", [](const P& b, const P& a) { return b.gap_m < a.gap_m; },
      [](const P& a, const P& b) { return a.thickness_m == b.thickness_m && a.current_m_per_s == b.current_m_per_s; },
      numbers);
}

void add_mooring(const PaperFolder& folder, const std::set<std::string>& names, FolderNumbers& numbers) {
  std::vector<RunNumber> all;
  for (const std::string& name : names)
    for (const RunNumber& number : folder.numbers(name, "mooring_over_ice_mean")) all.push_back(number);
  if (const auto every = over_runs(all, Over::every)) numbers["mooring_over_ice_mean_all"] = *every;
}

void add_repetition(const PaperFolder& folder, FolderNumbers& numbers) {
  if (folder.of(kRunOne).empty() || folder.of(kRunOneAgain).empty()) return;
  const PaperRun& one = folder.of(kRunOne).front();
  const PaperRun& again = folder.of(kRunOneAgain).front();
  // Only a run of the same case counts as a repetition.
  if (one.seed != again.seed || !differing_options(one.scene, again.scene).empty()) return;
  const PlatformPath a = path_of(one, kSecond);
  const PlatformPath b = path_of(again, kSecond);
  if (a.interval_s != b.interval_s || !a.exact || !b.exact || a.x.empty() || b.x.empty()) return;
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.x.size(), b.x.size()); ++i)
    largest = std::max({largest, std::abs(a.x[i] - b.x[i]), std::abs(a.y[i] - b.y[i])});
  numbers["repeated_run_distance_m"] = exact(largest, "1 pair");
}

void add_tail(const PaperFolder& folder, FolderNumbers& numbers) {
  std::vector<RunPeaks> runs;
  std::vector<double> all;
  for (const PaperRun& run : folder.of(kRunOne)) {
    const auto duration = run.numbers.find("duration_s");
    if (!duration) continue;
    runs.push_back({run.excursion_peaks, duration->value});
    all.insert(all.end(), run.excursion_peaks.begin(), run.excursion_peaks.end());
  }
  if (runs.size() < 2) return;
  const double thresholds[] = {percentile(all, 0.7)};
  const auto rows = threshold_stability(runs, thresholds, {0.9, kDay});
  if (!rows.empty())
    numbers["tail_shape"] = from(rows.front().shape, "95 % over " + std::to_string(runs.size()) + " runs, " +
                                                         std::to_string(rows.front().peaks) + " peaks");
}

}  // namespace

double ExcursionPoint::mean() const { return moments(largest_m).mean; }

std::optional<IntervalEstimate> ExcursionPoint::mean_interval() const {
  if (largest_m.size() < 2) return std::nullopt;
  return mean_of_runs(largest_m);
}

std::vector<ExcursionPoint> excursion_points(const PaperFolder& folder, const std::vector<TableRow>& rows) {
  std::vector<ExcursionPoint> points;
  for (const TableRow& row : rows) {
    if (row.table != "1") continue;
    ExcursionPoint point{row.run, 0.0, false, row.gap_m, row.current_m_per_s, {}};
    for (const RunNumber& number : folder.numbers(row.run, "orbit_largest_m")) point.largest_m.push_back(number.value);
    if (point.largest_m.empty()) continue;
    const std::vector<IceClassDef>& classes = folder.of(row.run).front().scene.floes.classes;
    double tenths = 0.0;
    for (const IceClassDef& ice : classes) {
      point.thickness_m += ice.thickness_m * ice.tenths;
      tenths += ice.tenths;
    }
    point.thickness_m /= tenths;
    point.mixed = classes.size() > 1;
    points.push_back(point);
  }
  return points;
}

FolderNumbers folder_numbers(const PaperFolder& folder, const Catalogue& catalogue) {
  FolderNumbers numbers;
  const std::set<std::string> names = names_of(catalogue.rows);
  const std::vector<ExcursionPoint> points = excursion_points(folder, catalogue.rows);
  add_totals(folder, names, numbers);
  add_trend(points, numbers);
  add_shares(points, numbers);
  add_mooring(folder, names, numbers);
  add_repetition(folder, numbers);
  add_tail(folder, numbers);
  return numbers;
}

}  // namespace gem
