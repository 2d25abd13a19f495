// Multiple regression with GSL, by singular values, which reveal dependent columns.
#include "validation/paper/analysis/fits/linear_model.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace gem {
namespace {

using Matrix = std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)>;
using Vector = std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)>;
using Workspace = std::unique_ptr<gsl_multifit_linear_workspace, decltype(&gsl_multifit_linear_free)>;

constexpr double kDependent = 1e-10;  // smallest singular value over the largest

void check(const std::vector<std::vector<double>>& columns, std::size_t points) {
  for (const std::vector<double>& column : columns)
    if (column.size() != points) throw std::invalid_argument("the columns of a linear model have unequal lengths");
  if (points < columns.size() + 3)
    throw std::invalid_argument("a linear model needs two points more than coefficients");
}

}  // namespace

LinearModel fit_linear_model(const std::vector<std::vector<double>>& columns, std::span<const double> y,
                             double confidence) {
  check(columns, y.size());
  const std::size_t points = y.size();
  const std::size_t terms = columns.size() + 1;
  const Matrix design(gsl_matrix_alloc(points, terms), gsl_matrix_free);
  const Matrix covariance(gsl_matrix_alloc(terms, terms), gsl_matrix_free);
  const Vector coefficients(gsl_vector_alloc(terms), gsl_vector_free);
  const Vector wanted(gsl_vector_alloc(points), gsl_vector_free);
  const Workspace workspace(gsl_multifit_linear_alloc(points, terms), gsl_multifit_linear_free);
  for (std::size_t i = 0; i < points; ++i) {
    gsl_vector_set(wanted.get(), i, y[i]);
    gsl_matrix_set(design.get(), i, 0, 1.0);
    for (std::size_t c = 1; c < terms; ++c) gsl_matrix_set(design.get(), i, c, columns[c - 1][i]);
  }
  double squares = 0.0;
  std::size_t rank = 0;
  gsl_multifit_linear_tsvd(design.get(), wanted.get(), kDependent, coefficients.get(), covariance.get(), &squares,
                           &rank, workspace.get());
  if (rank < terms) throw std::invalid_argument("the columns of a linear model depend on each other");
  const auto freedom = static_cast<double>(points - terms);
  const double quantile = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, freedom);
  const auto estimate = [&](std::size_t term) {
    const double value = gsl_vector_get(coefficients.get(), term);
    const double half = quantile * std::sqrt(gsl_matrix_get(covariance.get(), term, term));
    return IntervalEstimate{value, value - half, value + half};
  };
  LinearModel model;
  model.intercept = estimate(0);
  for (std::size_t c = 1; c < terms; ++c) model.slopes.push_back(estimate(c));
  model.scatter = std::sqrt(squares / freedom);
  return model;
}

}  // namespace gem
