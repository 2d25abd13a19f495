// Statistics over the findings of several runs.
#include "gem/analysis/runs_analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "gem/analysis/statistics/moments.h"

namespace gem {
namespace {

std::vector<double> values_of(const std::vector<std::vector<Finding>>& runs, std::size_t row) {
  std::vector<double> values;
  for (const std::vector<Finding>& run : runs) {
    if (run.size() != runs.front().size() || run[row].name != runs.front()[row].name)
      throw std::invalid_argument("the runs have different findings");
    if (!run[row].value) continue;
    // The sign of a largest excursion is that of one swing. Over runs its size counts.
    const bool largest = run[row].name.ends_with("_largest_m");
    values.push_back(largest ? std::abs(*run[row].value) : *run[row].value);
  }
  return values;
}

}  // namespace

std::vector<RunsFinding> combine_runs(const std::vector<std::vector<Finding>>& runs) {
  std::vector<RunsFinding> rows;
  if (runs.empty()) return rows;
  for (std::size_t row = 0; row < runs.front().size(); ++row) {
    const std::vector<double> values = values_of(runs, row);
    const Moments about = moments(values);
    RunsFinding finding{runs.front()[row].name, values.size(), 0.0, about.minimum, about.maximum, std::nullopt};
    if (values.size() == 1) finding.mean = IntervalEstimate{values[0], values[0], values[0]};
    if (values.size() > 1) {
      const auto count = static_cast<double>(values.size());
      finding.deviation = about.deviation * std::sqrt(count / (count - 1.0));
      finding.mean = mean_of_runs(values);
    }
    rows.push_back(finding);
  }
  return rows;
}

std::optional<RunsExtreme> extreme_of(const std::vector<std::vector<Finding>>& runs, const std::string& name,
                                      const Resampling& resampling) {
  std::vector<double> maxima;
  for (const std::vector<Finding>& run : runs)
    for (const Finding& finding : run)
      if (finding.name == name && finding.value) maxima.push_back(std::abs(*finding.value));
  const Moments about = moments(maxima);
  if (maxima.size() < 5 || !(about.maximum > about.minimum)) return std::nullopt;
  // The mode is the quantile of probability 1 / e.
  return RunsExtreme{name, fit_gumbel(maxima), fit_gumbel_by_moments(maxima),
                     gumbel_quantile(maxima, 1.0 / std::numbers::e, 1.0, resampling),
                     gumbel_quantile(maxima, 0.9, 1.0, resampling)};
}

}  // namespace gem
