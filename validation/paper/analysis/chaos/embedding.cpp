// Finds neighbours by comparing all states: records here have a few thousand samples.
#include "validation/paper/analysis/chaos/embedding.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace gem {

States::States(std::span<const double> signal, const Embedding& embedding) : signal_(signal), embedding_(embedding) {
  if (embedding.dimension == 0 || embedding.delay == 0 || embedding.theiler == 0)
    throw std::invalid_argument("an embedding needs a positive dimension, delay and Theiler window");
  const std::size_t reach = (embedding.dimension - 1) * embedding.delay;
  if (signal.size() < reach + 2) throw std::invalid_argument("the record is too short for its embedding");
  count_ = signal.size() - reach;
}

double States::squared_distance(std::size_t a, std::size_t b) const {
  double sum = 0.0;
  for (std::size_t d = 0; d < embedding_.dimension; ++d) {
    const double difference = signal_[a + d * embedding_.delay] - signal_[b + d * embedding_.delay];
    sum += difference * difference;
  }
  return sum;
}

std::vector<std::size_t> States::nearest(std::size_t of, std::size_t candidates, std::size_t wanted) const {
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t i = 0; i < std::min(candidates, count_); ++i) {
    const std::size_t apart = i > of ? i - of : of - i;
    if (apart <= embedding_.theiler) continue;
    const double distance = squared_distance(of, i);
    if (found.size() == wanted && distance >= found.back().first) continue;
    if (found.size() == wanted) found.pop_back();
    const std::pair<double, std::size_t> entry(distance, i);
    found.insert(std::upper_bound(found.begin(), found.end(), entry), entry);
  }
  std::vector<std::size_t> states;
  for (const auto& [distance, state] : found) states.push_back(state);
  return states;
}

}  // namespace gem
