// Computes distances of pairs of runs, and their growth rates.
#include "validation/paper/studies/divergence_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "gem/analysis/statistics/moments.h"
#include "gem/base/number_text.h"
#include "validation/paper/statements/settings_check.h"

namespace gem {
namespace {

constexpr double kOnset = 0.1;    // share of the swing at which growth is still exponential
constexpr double kParting = 0.5;  // share of the swing at which two curves look different

struct Path {
  std::vector<double> x, y, u, v;  // velocities over the natural frequency [m]
};

/// Empty if velocities or double precision were not kept: distances start far below single precision.
Path scaled_path(const PaperRun& run, double interval_s) {
  const PlatformPath motion = thinned(path_of(run, interval_s), interval_s);
  if (!motion.exact || motion.vx.empty() || motion.interval_s != interval_s) return {};
  const double scale = run.numbers.find("natural_period_s")->value / (2.0 * std::numbers::pi);
  Path path{motion.x, motion.y, motion.vx, motion.vy};
  for (std::vector<double>* velocity : {&path.u, &path.v})
    for (double& value : *velocity) value *= scale;
  return path;
}

/// The longest interval at which any of the paths was kept; a second if all runs have their files.
double common_interval(const std::vector<const PaperRun*>& runs) {
  double interval_s = 1.0;
  for (const PaperRun* run : runs)
    if (run->path && run->path->exact) interval_s = std::max(interval_s, run->path->interval_s);
  return interval_s;
}

std::vector<double> distance(const Path& a, const Path& b) {
  std::vector<double> result;
  for (std::size_t i = 0; i < std::min(a.x.size(), b.x.size()); ++i) {
    const double place = (a.x[i] - b.x[i]) * (a.x[i] - b.x[i]) + (a.y[i] - b.y[i]) * (a.y[i] - b.y[i]);
    const double speed = (a.u[i] - b.u[i]) * (a.u[i] - b.u[i]) + (a.v[i] - b.v[i]) * (a.v[i] - b.v[i]);
    result.push_back(std::sqrt(place + speed));
  }
  return result;
}

double moved(const PaperRun& run) { return length(run.scene.floes.moved_by_m); }

/// Each distance from the arrival of the disturbance on, cut to the length of the shortest. Distances of zero
/// throughout are left out.
std::vector<std::vector<double>> reached(const std::vector<std::vector<double>>& distances) {
  std::vector<std::vector<double>> result;
  std::size_t shortest = SIZE_MAX;
  for (const std::vector<double>& distance : distances) {
    if (distance.empty() || !(distance.back() > 0.0)) continue;
    // From the last zero on: while two paths differ only by rounding, they may become equal again.
    const auto zero = std::find(distance.rbegin(), distance.rend(), 0.0);
    result.emplace_back(zero.base(), distance.end());
    shortest = std::min(shortest, result.back().size());
  }
  for (std::vector<double>& distance : result) distance.resize(shortest);
  return result;
}

void add_growth(DivergenceStudy& study) {
  for (const DivergingPair& pair : study.pairs) {
    if (study.growth.contains(pair.moved_m)) continue;
    std::vector<std::vector<double>> distances;
    for (const DivergingPair& other : study.pairs)
      if (other.moved_m == pair.moved_m) distances.push_back(other.distance);
    if (const auto rate = growth_of(distances, study.interval_s, study.swing_m)) study.growth[pair.moved_m] = *rate;
  }
}

void add_shift(DivergenceStudy& study) {
  std::vector<double> sizes, onsets;
  std::vector<std::uint64_t> fields;
  for (const DivergingPair& pair : study.pairs)
    if (const auto onset = onset_time(pair.distance, study.interval_s, kOnset * study.swing_m)) {
      sizes.push_back(pair.moved_m);
      onsets.push_back(*onset);
      fields.push_back(pair.seed);
    }
  if (sizes.empty() || *std::min_element(sizes.begin(), sizes.end()) == *std::max_element(sizes.begin(), sizes.end()))
    return;
  if (sizes.size() >= std::set(fields.begin(), fields.end()).size() + 2)
    study.shift = onset_shift(sizes, onsets, fields);
}

}  // namespace

std::optional<GrowthRate> growth_of(const std::vector<std::vector<double>>& distances, double interval_s,
                                    double swing_m) {
  const auto grown = reached(distances);
  if (grown.size() < 2) return std::nullopt;
  const double start = std::exp(mean_log_distance(grown).front());
  return growth_rate(grown, interval_s, 10.0 * start, kOnset * swing_m);
}

void find_growth(DivergenceStudy& study) {
  add_growth(study);
  add_shift(study);
}

double parting_time(const std::vector<double>& distance, double interval_s, double swing_m) {
  return onset_time(distance, interval_s, kParting * swing_m).value_or(std::numeric_limits<double>::infinity());
}

DivergenceStudy divergence_study(const PaperFolder& folder) {
  std::map<std::uint64_t, const PaperRun*> undisturbed;
  std::vector<const PaperRun*> disturbed;
  for (const auto& [condition, runs] : folder.conditions)
    for (const PaperRun& run : runs) {
      if (run.scene.floes.moved_floe < 0 || !run.numbers.find("natural_period_s") || !run.numbers.find("x_deviation_m"))
        continue;
      if (moved(run) == 0.0)
        undisturbed[run.seed] = &run;
      else
        disturbed.push_back(&run);
    }
  DivergenceStudy study;
  std::vector<const PaperRun*> all = disturbed;
  for (const auto& [seed, run] : undisturbed) all.push_back(run);
  study.interval_s = common_interval(all);
  std::map<std::uint64_t, Path> paths;
  std::vector<double> swings;
  for (const auto& [seed, run] : undisturbed) {
    paths[seed] = scaled_path(*run, study.interval_s);
    swings.push_back(run->numbers.find("x_deviation_m")->value);
  }
  study.swing_m = moments(swings).mean;
  const std::vector<std::string> only = {"floes.moved_by_m"};
  for (const PaperRun* run : disturbed) {
    const auto base = paths.find(run->seed);
    if (base == paths.end() || differing_options(undisturbed.at(run->seed)->scene, run->scene) != only) continue;
    std::vector<double> apart = distance(base->second, scaled_path(*run, study.interval_s));
    if (!apart.empty()) study.pairs.push_back({moved(*run), run->seed, std::move(apart)});
  }
  if (study.swing_m > 0.0) find_growth(study);
  return study;
}

std::optional<IntervalEstimate> shift_over_growth(const DivergenceStudy& study) {
  if (!study.shift || study.growth.empty()) return std::nullopt;
  const IntervalEstimate& rate = study.growth.begin()->second.rate;
  const IntervalEstimate& slope = study.shift->slope;
  const std::array<double, 4> corners = {-slope.low * rate.low, -slope.low * rate.high, -slope.high * rate.low,
                                         -slope.high * rate.high};
  return IntervalEstimate{-slope.value * rate.value, *std::min_element(corners.begin(), corners.end()),
                          *std::max_element(corners.begin(), corners.end())};
}

void add_divergence_numbers(const DivergenceStudy& study, FolderNumbers& numbers) {
  const std::string pairs = "95 % over " + std::to_string(study.pairs.size()) + " pairs of all sizes";
  if (!study.growth.empty()) {
    const double size = study.growth.begin()->first;
    const auto own = std::count_if(study.pairs.begin(), study.pairs.end(),
                                   [size](const DivergingPair& pair) { return pair.moved_m == size; });
    const std::string of_size = "95 % over " + std::to_string(own) + " pairs moved by " + number_text(size) + " m";
    const IntervalEstimate& rate = study.growth.begin()->second.rate;
    numbers["divergence_rate_per_s"] = {rate.value, rate.low, rate.high, of_size};
    const IntervalEstimate& early = study.growth.begin()->second.early;
    const IntervalEstimate& late = study.growth.begin()->second.late;
    // Ratio of the worst ends of both intervals.
    if (early.low > 0.0)
      numbers["divergence_late_over_early"] = {late.value / early.value, late.low / early.high, late.high / early.low,
                                               of_size};
  }
  if (const auto share = shift_over_growth(study))
    numbers["onset_shift_over_growth"] = {share->value, share->low, share->high, pairs};
  std::map<double, std::vector<RunNumber>> parting;
  std::map<double, std::vector<RunNumber>> parted;
  for (const DivergingPair& pair : study.pairs) {
    const double at = parting_time(pair.distance, study.interval_s, study.swing_m);
    parting[pair.moved_m].push_back({at, at, at, false});
    const double share = std::isfinite(at) ? 1.0 : 0.0;
    parted[pair.moved_m].push_back({share, share, share, false});
  }
  for (const auto& [size, times] : parting) numbers["parting_s_" + number_text(size)] = *over_runs(times, Over::every);
  for (const auto& [size, shares] : parted)
    numbers["parted_share_" + number_text(size)] = *over_runs(shares, Over::mean);
}

}  // namespace gem
