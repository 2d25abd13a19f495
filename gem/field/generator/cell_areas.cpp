// Newton's method for the areas of power cells; its linear system is solved by conjugate gradients.
#include "gem/field/generator/cell_areas.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "gem/geometry/polygon.h"

namespace gem {
namespace {

constexpr int gradient_iterations = 400;
constexpr double gradient_tolerance = 1e-4;
constexpr double smallest_share = 0.2;  // of its wanted area that a cell keeps through a step [-]

using Values = std::vector<double>;

/// Rows of the Laplacian: neighbour and coefficient.
struct Laplacian {
  std::vector<std::vector<std::pair<std::size_t, double>>> row;
  Values diagonal;

  Values times(const Values& x) const {
    Values y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      y[i] = diagonal[i] * x[i];
      for (const auto& [j, c] : row[i]) y[i] -= c * x[j];
    }
    return y;
  }
};

Laplacian laplacian_of(const Diagram& diagram) {
  const std::size_t n = diagram.cells.size();
  Laplacian result{std::vector<std::vector<std::pair<std::size_t, double>>>(n), Values(n, 0.0)};
  for (std::size_t i = 0; i < n; ++i) {
    const LabelledPolygon& cell = diagram.cells[i];
    for (std::size_t e = 0; e < cell.corner.size(); ++e) {
      if (cell.label[e] == wall_label) continue;
      const auto j = static_cast<std::size_t>(cell.label[e]);
      // From the side of the lower site only: an obstacle may cut the two sides differently.
      if (j < i) continue;
      const double edge = length(cell.corner[(e + 1) % cell.corner.size()] - cell.corner[e]);
      const double c = 0.5 * edge / length(diagram.sites.position[j] - diagram.sites.position[i]);
      result.row[i].emplace_back(j, c);
      result.row[j].emplace_back(i, c);
      result.diagonal[i] += c;
      result.diagonal[j] += c;
    }
  }
  return result;
}

double product(const Values& a, const Values& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Conjugate gradients with the diagonal as preconditioner. The right side sums to 0: so the solution exists.
Values solve(const Laplacian& matrix, const Values& right) {
  const std::size_t n = right.size();
  Values x(n, 0.0), r = right, z(n), p(n, 0.0);
  double last = 0.0;
  const double enough = gradient_tolerance * gradient_tolerance * product(right, right);
  for (int k = 0; k < gradient_iterations && product(r, r) > enough; ++k) {
    for (std::size_t i = 0; i < n; ++i) z[i] = matrix.diagonal[i] > 0.0 ? r[i] / matrix.diagonal[i] : 0.0;
    const double now = product(r, z);
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + (k == 0 ? 0.0 : now / last) * p[i];
    const Values q = matrix.times(p);
    const double curvature = product(p, q);
    if (!(curvature > 0.0)) break;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += now / curvature * p[i];
      r[i] -= now / curvature * q[i];
    }
    last = now;
  }
  return x;
}

/// Smallest area of a cell over its wanted area.
double smallest_ratio(const Diagram& diagram, const Values& wanted) {
  double smallest = 1.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) smallest = std::min(smallest, diagram.area[i] / wanted[i]);
  return smallest;
}

}  // namespace

Diagram make_diagram(PowerSites sites, const MosaicRegion& region) {
  Diagram diagram{std::move(sites), {}, {}};
  diagram.cells = power_diagram(diagram.sites, region);
  for (const LabelledPolygon& cell : diagram.cells)
    diagram.area.push_back(cell.corner.empty() ? 0.0 : polygon_moments(cell.corner).area);
  return diagram;
}

double step_to_areas(Diagram& diagram, const MosaicRegion& region, const Values& wanted) {
  const double total = std::accumulate(diagram.area.begin(), diagram.area.end(), 0.0);
  const double scale = total / std::accumulate(wanted.begin(), wanted.end(), 0.0);
  Values target, lack;
  double error = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    target.push_back(scale * wanted[i]);
    lack.push_back(target[i] - diagram.area[i]);
    error = std::max(error, std::fabs(lack[i]) / target[i]);
  }
  const Values change = solve(laplacian_of(diagram), lack);
  const double allowed = smallest_share * smallest_ratio(diagram, target);
  for (double share = 1.0; share > 1e-3; share *= 0.5) {
    PowerSites sites = diagram.sites;
    for (std::size_t i = 0; i < change.size(); ++i) sites.weight[i] += share * change[i];
    Diagram next = make_diagram(std::move(sites), region);
    if (smallest_ratio(next, target) < allowed) continue;
    diagram = std::move(next);
    break;
  }
  return error;
}

void centre_sites(Diagram& diagram, const MosaicRegion& region) {
  for (double share = 1.0; share > 0.1; share *= 0.5) {
    PowerSites sites = diagram.sites;
    for (std::size_t i = 0; i < sites.position.size(); ++i)
      if (diagram.area[i] > 0.0)
        sites.position[i] += share * (polygon_moments(diagram.cells[i].corner).centroid - sites.position[i]);
    Diagram next = make_diagram(std::move(sites), region);
    if (*std::min_element(next.area.begin(), next.area.end()) <= 0.0) continue;
    diagram = std::move(next);
    return;
  }
}

}  // namespace gem
