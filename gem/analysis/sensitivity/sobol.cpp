// Estimators of Sobol indices.
#include "gem/analysis/sensitivity/sobol.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/statistics/moments.h"
#include "gem/analysis/statistics/random_streams.h"

namespace gem {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Correlation of two columns at the chosen rows; 0 if one of them is constant.
double correlation(const std::vector<double>& x, const std::vector<double>& y, std::span<const std::size_t> rows) {
  double mean_x = 0.0, mean_y = 0.0;
  for (const std::size_t i : rows) {
    mean_x += x[i] / static_cast<double>(rows.size());
    mean_y += y[i] / static_cast<double>(rows.size());
  }
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (const std::size_t i : rows) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

/// Variance between draws and within draws, for single runs.
struct Variance {
  double within = 0.0, total = 0.0;
};

Variance variance_of(const DrawnRuns& runs, std::span<const std::size_t> draws) {
  const auto repeats = static_cast<double>(runs.repeats());
  const auto count = static_cast<double>(draws.size());
  std::vector<double> means;
  double within = 0.0;
  for (const std::size_t i : draws) {
    means.push_back(mean_of(runs.outputs[i]));
    for (const double y : runs.outputs[i]) within += (y - means.back()) * (y - means.back());
  }
  const double mean = mean_of(means);
  double between = 0.0;
  for (const double m : means) between += (m - mean) * (m - mean);
  Variance result;
  result.within = repeats > 1.0 ? within / (count * (repeats - 1.0)) : 0.0;
  result.total = between / (count - 1.0) + result.within * (repeats - 1.0) / repeats;
  return result;
}

/// The index of one input from the chosen draws, which are in its order.
double neighbour_index(const std::vector<double>& means, std::span<const std::size_t> in_order, double variance) {
  double mean = 0.0, product = 0.0;
  for (const std::size_t i : in_order) mean += means[i] / static_cast<double>(in_order.size());
  for (std::size_t i = 0; i < in_order.size(); ++i) {
    // The last has no neighbour above; the one below takes its place.
    const std::size_t other = in_order[i + 1 < in_order.size() ? i + 1 : i - 1];
    product += (means[in_order[i]] - mean) * (means[other] - mean);
  }
  return variance > 0.0 ? product / static_cast<double>(in_order.size()) / variance : 0.0;
}

std::vector<std::size_t> order_of(const std::vector<double>& input) {
  std::vector<std::size_t> order(input.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return input[i] < input[j]; });
  return order;
}

/// Random halves of the draws, each ascending.
class Halves {
 public:
  Halves(std::size_t draws, std::uint64_t seed)
      : random_(random_sequence(seed, AnalysisStream::bootstrap)), all_(draws), is_in_(draws) {
    std::iota(all_.begin(), all_.end(), std::size_t{0});
  }
  const std::vector<bool>& next() {
    std::fill(is_in_.begin(), is_in_.end(), false);
    for (std::size_t i = 0; i < all_.size() / 2; ++i) {
      std::swap(all_[i], all_[i + random_.below(all_.size() - i)]);
      is_in_[all_[i]] = true;
    }
    return is_in_;
  }

 private:
  RandomSequence random_;
  std::vector<std::size_t> all_;
  std::vector<bool> is_in_;
};

/// A half sample scatters about its own mean as the whole sample does about the truth.
IntervalEstimate from_halves(double value, std::vector<double> halves, double confidence) {
  const double centre = mean_of(halves);
  std::sort(halves.begin(), halves.end());
  const double cut = 0.5 * (1.0 - confidence);
  return {value, value + percentile(halves, cut) - centre, value + percentile(halves, 1.0 - cut) - centre};
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const SaltelliRuns& runs, const Resampling& resampling) {
  const std::size_t draws = runs.a.size();
  bool fits = draws >= 3 && runs.b.size() == draws;
  for (const std::vector<double>& column : runs.a_with_b) fits = fits && column.size() == draws;
  if (!fits) throw std::invalid_argument("Sobol indices need three complete draws");
  const std::vector<IntervalEstimate> estimates = bootstrap_together(
      draws,
      [&](std::span<const std::size_t> rows) {
        std::vector<double> values;
        for (const std::vector<double>& column : runs.a_with_b) {
          values.push_back(correlation(runs.b, column, rows));
          values.push_back(1.0 - correlation(runs.a, column, rows));
        }
        return values;
      },
      resampling);
  std::vector<SobolIndex> indices;
  for (std::size_t k = 0; k < runs.a_with_b.size(); ++k) indices.push_back({estimates[2 * k], estimates[2 * k + 1]});
  return indices;
}

std::vector<IntervalEstimate> first_order_indices(const DrawnRuns& runs, const Resampling& resampling) {
  if (runs.draws() < kDrawsForFirstOrder) throw std::invalid_argument("too few draws for first-order indices");
  std::vector<double> means;
  for (const std::vector<double>& outputs : runs.outputs) means.push_back(mean_of(outputs));
  std::vector<std::vector<std::size_t>> order;
  for (const std::vector<double>& input : runs.inputs) order.push_back(order_of(input));
  std::vector<std::size_t> all(runs.draws());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const double variance = variance_of(runs, all).total;
  std::vector<std::vector<double>> halves(order.size());
  Halves half(runs.draws(), resampling.seed);
  for (std::size_t b = 0; b < resampling.count; ++b) {
    const std::vector<bool>& is_in = half.next();
    std::vector<std::size_t> chosen;
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [&](std::size_t i) { return is_in[i]; });
    const double half_variance = variance_of(runs, chosen).total;
    for (std::size_t k = 0; k < order.size(); ++k) {
      std::vector<std::size_t> in_order;
      std::copy_if(order[k].begin(), order[k].end(), std::back_inserter(in_order),
                   [&](std::size_t i) { return is_in[i]; });
      halves[k].push_back(neighbour_index(means, in_order, half_variance));
    }
  }
  std::vector<IntervalEstimate> indices;
  for (std::size_t k = 0; k < order.size(); ++k)
    indices.push_back(
        from_halves(neighbour_index(means, order[k], variance), std::move(halves[k]), resampling.confidence));
  return indices;
}

IntervalEstimate repeat_share(const DrawnRuns& runs, const Resampling& resampling) {
  if (runs.repeats() < 2 || runs.draws() < 3) throw std::invalid_argument("the share of repeats needs two of them");
  return bootstrap(
      runs.draws(),
      [&](std::span<const std::size_t> draws) {
        const Variance variance = variance_of(runs, draws);
        // Between draws the estimate may be below 0.
        return variance.total > 0.0 ? std::min(1.0, variance.within / variance.total) : 0.0;
      },
      resampling);
}

}  // namespace gem
