// Ranks of inputs and outputs.
#include "gem/analysis/sensitivity/input_runs.h"

#include <algorithm>
#include <numeric>

namespace gem {

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  std::vector<double> rank(values.size());
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) rank[order[i]] = 0.5 * static_cast<double>(begin + end + 1);
  }
  return rank;
}

DrawnRuns ranked(const DrawnRuns& runs) {
  DrawnRuns result;
  for (const std::vector<double>& input : runs.inputs) result.inputs.push_back(ranks(input));
  std::vector<double> all;
  for (const std::vector<double>& outputs : runs.outputs) all.insert(all.end(), outputs.begin(), outputs.end());
  const std::vector<double> rank = ranks(all);
  for (std::size_t i = 0; i < rank.size(); i += runs.repeats())
    result.outputs.emplace_back(rank.begin() + static_cast<std::ptrdiff_t>(i),
                                rank.begin() + static_cast<std::ptrdiff_t>(i + runs.repeats()));
  return result;
}

}  // namespace gem
