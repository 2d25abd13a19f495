// Mean of one correlated record, with its interval.
#include "gem/analysis/statistics/record_mean.h"

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/moments.h"

namespace gem {

Finding mean_of(const std::string& name, const std::vector<double>& record) {
  constexpr std::size_t stretches = 20;
  const double mean = moments(record).mean;
  if (record.size() < 2 * stretches) return {name, mean, {}};
  return {name, mean, moving_block_mean(record, record.size() / stretches)};
}

}  // namespace gem
