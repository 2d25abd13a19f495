// Nearest neighbours, followed.
#include "gem/analysis/chaos/rosenstein.h"

#include <gsl/gsl_cdf.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/statistics/line_fit.h"
#include "gem/analysis/statistics/moments.h"

namespace gem {
namespace {

struct Sums {
  std::vector<double> log_distance, count;

  void add(std::size_t step, double squared_distance) {
    if (!(squared_distance > 0.0)) return;  // neighbours that are the same state tell nothing
    log_distance[step] += 0.5 * std::log(squared_distance);
    count[step] += 1.0;
  }
  std::vector<double> mean() const {
    std::vector<double> result;
    for (std::size_t k = 0; k < count.size(); ++k) result.push_back(log_distance[k] / count[k]);
    return result;
  }
};

}  // namespace

NeighbourDivergence neighbour_divergence(std::span<const double> signal, const Embedding& embedding, std::size_t steps,
                                         std::size_t parts) {
  const States states(signal, embedding);
  if (parts == 0 || states.count() < steps + 10 * parts)
    throw std::invalid_argument("the record is too short to follow its neighbours");
  const std::size_t references = states.count() - steps;
  std::vector<Sums> sums(parts, {std::vector<double>(steps + 1, 0.0), std::vector<double>(steps + 1, 0.0)});
  for (std::size_t i = 0; i < references; ++i) {
    const std::vector<std::size_t> neighbour = states.nearest(i, references, 1);
    if (neighbour.empty()) continue;
    Sums& part = sums[i * parts / references];
    for (std::size_t k = 0; k <= steps; ++k) part.add(k, states.squared_distance(i + k, neighbour[0] + k));
  }
  NeighbourDivergence divergence;
  divergence.mean.assign(steps + 1, 0.0);
  for (const Sums& part : sums) {
    divergence.part.push_back(part.mean());
    for (std::size_t k = 0; k <= steps; ++k)
      divergence.mean[k] += divergence.part.back()[k] / static_cast<double>(parts);
  }
  return divergence;
}

IntervalEstimate divergence_rate(const NeighbourDivergence& divergence, double interval_s, std::size_t first,
                                 std::size_t last) {
  if (divergence.part.size() < 2 || last < first + 2 || last >= divergence.mean.size())
    throw std::invalid_argument("a rate of divergence needs two parts and three samples of the curve");
  std::vector<double> time;
  for (std::size_t k = first; k <= last; ++k) time.push_back(static_cast<double>(k) * interval_s);
  std::vector<double> slopes;
  for (const std::vector<double>& curve : divergence.part)
    slopes.push_back(fit_line(time, std::span(curve).subspan(first, time.size())).slope.value);
  const Moments about = moments(slopes);
  const double freedom = static_cast<double>(slopes.size()) - 1.0;
  const double half = gsl_cdf_tdist_Pinv(0.975, freedom) * about.deviation / std::sqrt(freedom);
  return {about.mean, about.mean - half, about.mean + half};
}

}  // namespace gem
