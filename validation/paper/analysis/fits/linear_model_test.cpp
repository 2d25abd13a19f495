// The regression fits a plane exactly, agrees with a line, and refuses dependent columns.
#include "validation/paper/analysis/fits/linear_model.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "validation/paper/analysis/fits/line_fit.h"

namespace gem {
namespace {

TEST(LinearModel, FindsAPlaneExactly) {
  const std::vector<std::vector<double>> columns = {{0, 1, 2, 0, 1, 2}, {0, 0, 0, 1, 1, 3}};
  std::vector<double> y;
  for (std::size_t i = 0; i < 6; ++i) y.push_back(2.0 + 3.0 * columns[0][i] - 0.5 * columns[1][i]);
  const LinearModel model = fit_linear_model(columns, y);
  EXPECT_NEAR(model.intercept.value, 2.0, 1e-12);
  EXPECT_NEAR(model.slopes[0].value, 3.0, 1e-12);
  EXPECT_NEAR(model.slopes[1].value, -0.5, 1e-12);
  EXPECT_NEAR(model.scatter, 0.0, 1e-12);
}

TEST(LinearModel, IsTheLineFitForOneColumn) {
  const std::vector<double> x = {0.0, 1.0, 2.0, 3.0, 4.0};
  const std::vector<double> y = {0.1, 0.9, 2.2, 2.8, 4.1};
  const LinearModel model = fit_linear_model({x}, y);
  const LineFit line = fit_line(x, y);
  EXPECT_NEAR(model.slopes[0].value, line.slope.value, 1e-12);
  EXPECT_NEAR(model.slopes[0].low, line.slope.low, 1e-12);
  EXPECT_NEAR(model.intercept.high, line.intercept.high, 1e-12);
  EXPECT_NEAR(model.scatter, line.scatter, 1e-12);
}

TEST(LinearModel, RefusesDependentColumnsAndTooFewPoints) {
  const std::vector<double> x = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0};
  EXPECT_THROW(fit_linear_model({x, {0.0, 2.0, 4.0, 6.0, 8.0, 10.0}}, x), std::invalid_argument);
  EXPECT_THROW(fit_linear_model({{1.0, 2.0, 4.0}}, std::vector<double>{1.0, 2.0, 3.0}), std::invalid_argument);
  EXPECT_THROW(fit_linear_model({{1.0, 2.0, 4.0}}, x), std::invalid_argument);
}

}  // namespace
}  // namespace gem
