// Counts conditional exceedances and fits their tail.
#include "validation/paper/analysis/extremes/acer.h"

#include <gsl/gsl_multimin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace gem {
namespace {

/// Rate in one run: exceedances that follow k - 1 peaks below the level, over peaks that have k - 1 peaks before them.
double rate_of(const std::vector<double>& peaks, std::size_t order, double level) {
  std::size_t below = 0;  // number of consecutive peaks below the level up to here
  std::size_t count = 0;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    const bool above = peaks[i] > level;
    if (above && i + 1 >= order && below >= order - 1) ++count;
    below = above ? 0 : below + 1;
  }
  return static_cast<double>(count) / static_cast<double>(peaks.size() - order + 1);
}

/// ln(rate) at the levels of the tail, weighted by the width of the intervals.
struct TailPoints {
  std::vector<double> level, log_rate, weight;
};

TailPoints tail_points(const AcerCurve& curve, double tail_start) {
  TailPoints points;
  for (std::size_t i = 0; i < curve.level.size(); ++i) {
    const double low = curve.rate[i] - curve.half_width[i];
    if (curve.level[i] < tail_start || !(low > 0.0)) continue;
    const double spread = std::log((curve.rate[i] + curve.half_width[i]) / low);
    points.level.push_back(curve.level[i]);
    points.log_rate.push_back(std::log(curve.rate[i]));
    // A rate that is equal in all runs still has an uncertainty.
    points.weight.push_back(1.0 / std::max(spread * spread, 1e-6));
  }
  return points;
}

struct Fitted {
  AcerTail tail;
  double misfit = std::numeric_limits<double>::infinity();
};

/// For given b and c the fit of ln q and a is a weighted straight line.
Fitted fit_for(const TailPoints& points, double b, double c) {
  if (!(b < points.level.front()) || c < 0.5 || c > 5.0) return {};
  double w = 0.0, wx = 0.0, wy = 0.0, wxx = 0.0, wxy = 0.0;
  std::vector<double> x;
  for (std::size_t i = 0; i < points.level.size(); ++i) {
    x.push_back(std::pow(points.level[i] - b, c));
    w += points.weight[i];
    wx += points.weight[i] * x[i];
    wy += points.weight[i] * points.log_rate[i];
    wxx += points.weight[i] * x[i] * x[i];
    wxy += points.weight[i] * x[i] * points.log_rate[i];
  }
  const double slope = (w * wxy - wx * wy) / (w * wxx - wx * wx);
  const double start = (wy - slope * wx) / w;
  if (!(slope < 0.0) || !std::isfinite(start)) return {};
  Fitted fitted{{std::exp(start), -slope, b, c}, 0.0};
  for (std::size_t i = 0; i < x.size(); ++i)
    fitted.misfit += points.weight[i] * std::pow(points.log_rate[i] - start - slope * x[i], 2);
  return fitted;
}

/// The search variables: the gap between b and the lowest level in units of the range of levels, and c.
struct RateSearch {
  const TailPoints& points;
  double lowest, range;

  Fitted at(double log_gap, double c) const { return fit_for(points, lowest - range * std::exp(log_gap), c); }
  static double misfit(const gsl_vector* at, void* search) {
    const double value = static_cast<RateSearch*>(search)->at(gsl_vector_get(at, 0), gsl_vector_get(at, 1)).misfit;
    return std::isfinite(value) ? value : 1e30;
  }
};

Fitted search_from(RateSearch& search, double log_gap, double c) {
  struct Free {
    void operator()(gsl_multimin_fminimizer* minimizer) const { gsl_multimin_fminimizer_free(minimizer); }
  };
  std::array<double, 2> start = {log_gap, c};
  std::array<double, 2> step = {0.5, 0.3};
  const gsl_vector_view from = gsl_vector_view_array(start.data(), 2);
  const gsl_vector_view by = gsl_vector_view_array(step.data(), 2);
  const std::unique_ptr<gsl_multimin_fminimizer, Free> minimizer(
      gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2));
  gsl_multimin_function function = {&RateSearch::misfit, 2, &search};
  gsl_multimin_fminimizer_set(minimizer.get(), &function, &from.vector, &by.vector);
  for (int pass = 0; pass < 200; ++pass)
    if (gsl_multimin_fminimizer_iterate(minimizer.get()) != 0 || gsl_multimin_fminimizer_size(minimizer.get()) < 1e-4)
      break;
  return search.at(gsl_vector_get(minimizer->x, 0), gsl_vector_get(minimizer->x, 1));
}

double largest_peak(const std::vector<std::vector<double>>& runs) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const std::vector<double>& run : runs)
    for (const double peak : run) largest = std::max(largest, peak);
  return largest;
}

std::optional<double> quantile_of(const std::vector<std::vector<double>>& runs, const AcerQuestion& question) {
  const double range = largest_peak(runs) - question.tail_start;
  if (!(range > 0.0) || question.levels < 4) return std::nullopt;
  std::vector<double> levels;
  for (std::size_t i = 0; i < question.levels; ++i)
    levels.push_back(question.tail_start + range * static_cast<double>(i) / static_cast<double>(question.levels));
  const auto tail = fit_acer_tail(acer(runs, question.order, levels), question.tail_start);
  if (!tail) return std::nullopt;
  return tail->quantile(question.p, question.peaks - static_cast<double>(question.order) + 1.0);
}

}  // namespace

AcerCurve acer(const std::vector<std::vector<double>>& runs, std::size_t order, std::span<const double> levels) {
  const bool all_long = std::all_of(runs.begin(), runs.end(), [&](const auto& run) { return run.size() > order; });
  if (runs.size() < 2 || order == 0 || !all_long)
    throw std::invalid_argument("exceedance rates need two runs with more peaks than their order");
  AcerCurve curve;
  curve.order = order;
  const auto count = static_cast<double>(runs.size());
  for (const double level : levels) {
    double sum = 0.0;
    double squares = 0.0;
    for (const std::vector<double>& run : runs) {
      const double rate = rate_of(run, order, level);
      sum += rate;
      squares += rate * rate;
    }
    const double variance = std::max(0.0, squares - sum * sum / count) / (count - 1.0);
    curve.level.push_back(level);
    curve.rate.push_back(sum / count);
    curve.half_width.push_back(1.96 * std::sqrt(variance / count));
  }
  return curve;
}

double AcerTail::rate(double level) const { return q * std::exp(-a * std::pow(level - b, c)); }

double AcerTail::quantile(double p, double peaks) const {
  const double wanted = -std::log(p) / peaks;
  return b + std::pow(std::max(0.0, std::log(q / wanted) / a), 1.0 / c);
}

std::optional<AcerTail> fit_acer_tail(const AcerCurve& curve, double tail_start) {
  const TailPoints points = tail_points(curve, tail_start);
  if (points.level.size() < 4) return std::nullopt;
  RateSearch search{points, points.level.front(), points.level.back() - points.level.front()};
  // Several starts, because the misfit has a narrow curved valley in b and c.
  Fitted best;
  for (const double c : {1.0, 2.0, 3.0}) {
    const Fitted fitted = search_from(search, 0.0, c);
    if (fitted.misfit < best.misfit) best = fitted;
  }
  if (!std::isfinite(best.misfit)) return std::nullopt;
  return best.tail;
}

std::optional<IntervalEstimate> acer_quantile(const std::vector<std::vector<double>>& runs,
                                              const AcerQuestion& question, const Resampling& resampling) {
  const std::optional<double> all = quantile_of(runs, question);
  if (!all) return std::nullopt;
  return bootstrap(
      runs.size(),
      [&](std::span<const std::size_t> chosen) {
        std::vector<std::vector<double>> resample;
        for (const std::size_t run : chosen) resample.push_back(runs[run]);
        // A resample whose tail cannot be fitted counts as the fit to all runs.
        return quantile_of(resample, question).value_or(*all);
      },
      resampling);
}

}  // namespace gem
