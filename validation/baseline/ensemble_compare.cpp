#include "validation/baseline/ensemble_compare.h"

#include <cmath>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/equivalence.h"

namespace gem::baseline {
namespace {

constexpr double level = 0.05;
constexpr const char* too_few = "too few runs";

std::vector<double> finite_values(const BySeed& by_seed) {
  std::vector<double> values;
  for (const auto& [seed, value] : by_seed)
    if (std::isfinite(value)) values.push_back(value);
  return values;
}

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation_of(std::span<const double> values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

std::vector<double> paired(const BySeed& first, const BySeed& other) {
  std::vector<double> differences;
  for (const auto& [seed, value] : first)
    if (const auto found = other.find(seed); found != other.end() && std::isfinite(found->second - value))
      differences.push_back(found->second - value);
  return differences;
}

const BySeed& values_named(const std::map<std::string, BySeed>& all, const std::string& name) {
  static const BySeed none;
  const auto found = all.find(name);
  return found == all.end() ? none : found->second;
}

Compared compared(const PlannedQuantity& quantity, double margin, const BySeed& first, const BySeed& other) {
  Compared row;
  row.quantity = quantity.name;
  row.margin = margin;
  const std::vector<double> a = finite_values(first), b = finite_values(other), pairs = paired(first, other);
  row.runs_first = a.size();
  row.runs = b.size();
  row.verdict = too_few;
  if (a.size() < 3 || b.size() < 3 || !(margin > 0.0)) return row;
  row.first = bootstrap_values(a, mean_of);
  row.other = bootstrap_values(b, mean_of);
  row.deviation_first = deviation_of(a);
  row.deviation = deviation_of(b);
  if (pairs.size() >= 2) row.paired_difference = bootstrap_values(pairs, mean_of);
  const Equivalence test = equivalence_test(a, b, margin, level);
  row.difference = test.difference;
  row.p = test.p;
  row.verdict.clear();
  return row;
}

/// Sets the verdict of each row that has enough runs.
void judge(std::vector<Compared>& rows) {
  std::vector<Compared*> tested;
  std::vector<double> p;
  for (Compared& row : rows) {
    if (row.verdict == too_few) continue;
    tested.push_back(&row);
    p.push_back(row.p);
  }
  const std::vector<double> adjusted = holm(p);
  for (std::size_t k = 0; k < tested.size(); ++k) {
    Compared& row = *tested[k];
    row.p_holm = adjusted[k];
    const bool beyond = row.difference.low > row.margin || row.difference.high < -row.margin;
    row.verdict = row.p_holm < level ? "equivalent" : beyond ? "beyond the margin" : "undecided";
  }
}

}  // namespace

std::vector<Compared> compare(const EnsemblePlan& plan, const std::map<std::string, BySeed>& first,
                              const std::map<std::string, BySeed>& other) {
  std::vector<Compared> rows;
  for (const PlannedQuantity& quantity : plan.quantities) {
    double margin = quantity.margin;
    if (quantity.of != "absolute") {
      const std::vector<double> base = finite_values(values_named(first, quantity.of));
      margin *= base.empty() ? 0.0 : std::fabs(mean_of(base));
    }
    rows.push_back(compared(quantity, margin, values_named(first, quantity.name), values_named(other, quantity.name)));
  }
  judge(rows);
  return rows;
}

}  // namespace gem::baseline
