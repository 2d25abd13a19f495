// Algorithm:
//   sweep      projected Gauss-Seidel: each unknown in turn takes what makes its own w zero, within its bounds; a few
//              dozen sweeps find which unknowns end at a bound
//   finish     with those at their bounds, the others are the answer of linear equations, solved by factorisation
//              (semi-smooth Newton: Alart and Curnier 1991; after sweeps: Silcowitz et al. 2010)
//   in turns until what is left is rounding. A finish that leaves more than there was is dropped.
#include "gem/engine/reference/bounded_problem.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include "gem/base/error.h"

namespace gem {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

struct Bounds {
  double lower, upper;
};

Bounds bounds_of(const BoundedProblem& p, const Vector& x, int i) {
  if (p.normal[i] == BoundedProblem::none) return {0.0, p.limit[i]};
  const double most = p.limit[i] * x[p.normal[i]];
  return {-most, most};
}

double within(double value, Bounds bounds) { return std::min(std::max(value, bounds.lower), bounds.upper); }

/// How an unknown answers to itself. One that answers to nothing keeps its value.
double own_response(const BoundedProblem& p, int i) { return p.response.coeff(i, i); }

class Solver {
 public:
  explicit Solver(const BoundedProblem& problem) : p_(problem), x_(Vector::Zero(problem.start.size())) {
    own_.resize(size());
    for (int i = 0; i < size(); ++i) own_[i] = own_response(p_, i);
  }

  BoundedSolution solve();

 private:
  int size() const { return static_cast<int>(p_.start.size()); }
  void sweep();
  void finish();
  bool step_to_equations();
  double residual(const Vector& x) const;
  /// The largest sum of the sizes of the terms of w: rounding is a share of it.
  double scale() const;

  const BoundedProblem& p_;
  Vector x_, own_;
  double left_ = 0.0;
};

void Solver::sweep() {
  for (int i = 0; i < size(); ++i) {
    double w = p_.start[i];
    for (Matrix::InnerIterator k(p_.response, i); k; ++k) w += k.value() * x_[k.col()];
    x_[i] = within(x_[i] - w / own_[i], bounds_of(p_, x_, i));
  }
}

double Solver::residual(const Vector& x) const {
  const Vector w = p_.response * x + p_.start;
  double largest = 0.0;
  for (int i = 0; i < size(); ++i) {
    const double change = x[i] - within(x[i] - w[i] / own_[i], bounds_of(p_, x, i));
    largest = std::max(largest, own_[i] * std::fabs(change));
  }
  return largest;
}

double Solver::scale() const {
  double largest = 0.0;
  for (int i = 0; i < size(); ++i) {
    double sum = std::fabs(p_.start[i]);
    for (Matrix::InnerIterator k(p_.response, i); k; ++k) sum += std::fabs(k.value() * x_[k.col()]);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// One step of Newton: unknowns that would pass a bound are set to it, the rest make their w zero. False, and nothing
/// changed, if that leaves more than there was.
bool Solver::step_to_equations() {
  const Vector w = p_.response * x_ + p_.start;
  Vector x = x_;
  std::vector<int> column(size(), -1);                    // of a free unknown among the free ones
  std::vector<Eigen::Triplet<double>> pick, spread;       // free unknowns of all; all that follow a free one
  for (int i = 0; i < size(); ++i) {
    const double wanted = x_[i] - w[i] / own_[i];
    const Bounds bounds = bounds_of(p_, x_, i);
    const bool free = wanted > bounds.lower && wanted < bounds.upper;
    const int normal = p_.normal[i];
    if (free) {
      column[i] = static_cast<int>(pick.size());
      pick.emplace_back(column[i], i, 1.0);
      spread.emplace_back(i, column[i], 1.0);
    } else if (normal == BoundedProblem::none) {
      x[i] = within(wanted, bounds);
    } else {
      const double share = wanted > 0.0 ? p_.limit[i] : -p_.limit[i];
      x[i] = share * x[normal];
      if (column[normal] >= 0) spread.emplace_back(i, column[normal], share);
    }
  }
  const int count = static_cast<int>(pick.size());
  if (count > 0) {
    Eigen::SparseMatrix<double> picked(count, size()), follows(size(), count);
    picked.setFromTriplets(pick.begin(), pick.end());
    follows.setFromTriplets(spread.begin(), spread.end());
    Eigen::SparseMatrix<double> equations = picked * p_.response * follows;
    // impulses that hold each other need not be unique: a little on the diagonal picks some, and the next step takes
    // away what it costs
    constexpr double little = 1e-10;
    const Vector own = picked * own_;
    for (int i = 0; i < count; ++i) equations.coeffRef(i, i) += little * own[i];
    equations.makeCompressed();
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(equations);
    if (factors.info() != Eigen::Success) return false;
    const Vector missing = picked * Vector(p_.response * x + p_.start);
    x -= follows * Vector(factors.solve(missing));
  }
  for (int i = 0; i < size(); ++i) x[i] = within(x[i], bounds_of(p_, x, i));
  const double left = residual(x);
  if (!(left < left_)) return false;
  x_ = x;
  left_ = left;
  return true;
}

void Solver::finish() {
  constexpr int most = 30;
  for (int step = 0; step < most && left_ > 0.0; ++step)
    if (!step_to_equations()) return;
}

BoundedSolution Solver::solve() {
  constexpr int most_sweeps = 200000;
  int sweeps = 0;
  for (int block = 20; sweeps < most_sweeps; block += block / 2) {
    for (int s = 0; s < block; ++s) sweep();
    sweeps += block;
    left_ = residual(x_);
    if (!std::isfinite(left_)) break;
    finish();
    if (left_ <= bounded_tolerance * scale()) return {x_, left_, sweeps};
  }
  throw Error(ExitCode::numerical_stop,
              "the reference engine found no impulses for " + std::to_string(size()) +
                  " unknowns of touching bodies within " + std::to_string(sweeps) +
                  " sweeps (friction may leave none); try the engine cpu or a smaller numerics.moment_s");
}

}  // namespace

BoundedSolution solve(const BoundedProblem& problem) { return Solver(problem).solve(); }

}  // namespace gem
