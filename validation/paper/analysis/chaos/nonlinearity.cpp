// Asymmetry from differences, predictability from neighbours.
#include "validation/paper/analysis/chaos/nonlinearity.h"

#include <cmath>
#include <stdexcept>

#include "gem/analysis/statistics/moments.h"

namespace gem {

double time_reversal_asymmetry(std::span<const double> signal, std::size_t lag) {
  if (lag == 0 || signal.size() <= lag) throw std::invalid_argument("the record is too short for its lag");
  double squares = 0.0;
  double cubes = 0.0;
  for (std::size_t i = lag; i < signal.size(); ++i) {
    const double difference = signal[i] - signal[i - lag];
    squares += difference * difference;
    cubes += difference * difference * difference;
  }
  const auto count = static_cast<double>(signal.size() - lag);
  return squares > 0.0 ? cubes / count / std::pow(squares / count, 1.5) : 0.0;
}

double prediction_error(std::span<const double> signal, const NeighbourForecast& forecast) {
  const States states(signal, forecast.embedding);
  const double deviation = moments(signal).deviation;
  if (states.count() < forecast.horizon + 2 || forecast.neighbours == 0 || !(deviation > 0.0))
    throw std::invalid_argument("the record is too short or too even to be predicted");
  const std::size_t known = states.count() - forecast.horizon;
  // The newest coordinate of a state is the present; its future lies `horizon` samples later.
  const std::size_t ahead = signal.size() - states.count() + forecast.horizon;
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < known; ++i) {
    const std::vector<std::size_t> neighbours = states.nearest(i, known, forecast.neighbours);
    if (neighbours.empty()) continue;
    double mean = 0.0;
    for (const std::size_t n : neighbours) mean += signal[n + ahead] / static_cast<double>(neighbours.size());
    squares += (signal[i + ahead] - mean) * (signal[i + ahead] - mean);
    count += 1.0;
  }
  if (!(count > 0.0)) throw std::invalid_argument("no state has a neighbour outside the Theiler window");
  return std::sqrt(squares / count) / deviation;
}

}  // namespace gem
