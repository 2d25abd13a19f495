// Standardised linear regression by least squares.
#include "gem/analysis/sensitivity/regression.h"

#include <gsl/gsl_multifit.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace gem {
namespace {

struct Standard {
  double mean = 0.0;
  double scale = 0.0;  // 1 / deviation; 0 for equal values
};

template <class Value>
Standard standard_of(std::size_t count, const Value& value) {
  Standard result;
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) result.mean += value(i) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) sum += (value(i) - result.mean) * (value(i) - result.mean);
  const double deviation = std::sqrt(sum / static_cast<double>(count));
  result.scale = deviation > 1e-12 * std::abs(result.mean) && deviation > 0.0 ? 1.0 / deviation : 0.0;
  return result;
}

/// Memory of one fit, used again for each resample.
class Fit {
 public:
  explicit Fit(const DrawnRuns& runs)
      : runs_(runs),
        rows_(runs.draws() * runs.repeats()),
        columns_(runs.inputs.size()),
        space_(gsl_multifit_linear_alloc(rows_, columns_), gsl_multifit_linear_free),
        x_(gsl_matrix_alloc(rows_, columns_), gsl_matrix_free),
        covariance_(gsl_matrix_alloc(columns_, columns_), gsl_matrix_free),
        y_(gsl_vector_alloc(rows_), gsl_vector_free),
        c_(gsl_vector_alloc(columns_), gsl_vector_free) {}

  /// Standardised coefficients of the chosen draws, then R squared. Zeros if all outputs are equal.
  std::vector<double> operator()(std::span<const std::size_t> draws) {
    const std::size_t repeats = runs_.repeats();
    const auto output = [&](std::size_t row) { return runs_.outputs[draws[row / repeats]][row % repeats]; };
    const Standard y = standard_of(rows_, output);
    std::vector<double> result(columns_ + 1, 0.0);
    if (y.scale == 0.0) return result;
    for (std::size_t row = 0; row < rows_; ++row) gsl_vector_set(y_.get(), row, (output(row) - y.mean) * y.scale);
    for (std::size_t k = 0; k < columns_; ++k) {
      const Standard x = standard_of(draws.size(), [&](std::size_t i) { return runs_.inputs[k][draws[i]]; });
      for (std::size_t row = 0; row < rows_; ++row)
        gsl_matrix_set(x_.get(), row, k, (runs_.inputs[k][draws[row / repeats]] - x.mean) * x.scale);
    }
    double residual = 0.0;
    // Columns that depend on each other or are zero get the smallest coefficients.
    std::size_t rank = 0;
    gsl_multifit_linear_tsvd(x_.get(), y_.get(), 1e-10, c_.get(), covariance_.get(), &residual, &rank, space_.get());
    for (std::size_t k = 0; k < columns_; ++k) result[k] = gsl_vector_get(c_.get(), k);
    result[columns_] = 1.0 - residual / static_cast<double>(rows_);
    return result;
  }

 private:
  const DrawnRuns& runs_;
  std::size_t rows_, columns_;
  std::unique_ptr<gsl_multifit_linear_workspace, void (*)(gsl_multifit_linear_workspace*)> space_;
  std::unique_ptr<gsl_matrix, void (*)(gsl_matrix*)> x_, covariance_;
  std::unique_ptr<gsl_vector, void (*)(gsl_vector*)> y_, c_;
};

/// A share is at most 1. Inputs that are correlated by chance may give more.
IntervalEstimate squared(const IntervalEstimate& c) {
  const auto share = [](double coefficient) { return std::min(1.0, coefficient * coefficient); };
  const double low = share(c.low), high = share(c.high);
  return {share(c.value), c.holds(0.0) ? 0.0 : std::min(low, high), std::max(low, high)};
}

}  // namespace

TrendShares trend_shares(const DrawnRuns& runs, const Resampling& resampling) {
  const std::size_t inputs = runs.inputs.size();
  if (inputs == 0 || runs.draws() < draws_for_trends(inputs)) throw std::invalid_argument("too few draws for a trend");
  Fit fit(runs);
  const std::vector<IntervalEstimate> estimates = bootstrap_together(
      runs.draws(), [&](std::span<const std::size_t> draws) { return fit(draws); }, resampling);
  TrendShares result;
  for (std::size_t k = 0; k < inputs; ++k) result.inputs.push_back({estimates[k], squared(estimates[k])});
  const double rows = static_cast<double>(runs.draws() * runs.repeats());
  result.explained = 1.0 - (1.0 - estimates[inputs].value) * (rows - 1.0) / (rows - 1.0 - static_cast<double>(inputs));
  return result;
}

}  // namespace gem
