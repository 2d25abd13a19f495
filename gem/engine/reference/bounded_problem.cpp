// Algorithm: two phases in turn, until the residual is rounding.
//   approach   operator splitting (Stellato et al. 2020; with friction: Tasora et al. 2021). Solves w = 0 with a
//              spring to the last impulses within bounds, then applies the bounds. Finds which unknowns end at a bound.
//   finish     semi-smooth Newton (Alart and Curnier 1991). The unknowns at a bound are fixed, the others solve linear
//              equations. Impulses that hold each other need not be unique, so a small term is added to the diagonal.
//              Several sizes of the term are tried and the best result is kept.
// Step counts, springs and sizes of the term were chosen by hand. They affect speed and which problems are solved, but
// not the tolerance of a solution.
#include "gem/engine/reference/bounded_problem.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <string>

#include "gem/base/error.h"

namespace gem::reference {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Factors = Eigen::SparseLU<Matrix>;

struct Bounds {
  double lower, upper;
};

Bounds bounds_of(const BoundedProblem& p, const Vector& x, int i) {
  if (p.normal[i] == BoundedProblem::none) return {0.0, p.limit[i]};
  const double most = p.limit[i] * x[p.normal[i]];
  return {-most - p.spare[i].right, most + p.spare[i].left};
}

/// Growth of the bounds when x grows by `change`.
Bounds growth_of_bounds(const BoundedProblem& p, const Vector& change, int i) {
  if (p.normal[i] == BoundedProblem::none) return {0.0, 0.0};
  const double most = p.limit[i] * change[p.normal[i]];
  return {-most, most};
}

double within(double value, Bounds bounds) { return std::min(std::max(value, bounds.lower), bounds.upper); }

class Solver {
 public:
  explicit Solver(const BoundedProblem& problem)
      : p_(problem), own_(problem.response.diagonal()), bounded_(Vector::Zero(problem.start.size())), pull_(bounded_) {
    take(bounded_);
  }

  BoundedSolution solve(int most_rounds);

 private:
  /// Which unknowns end at a bound, as matrices that take the free ones from all, and all from the free ones.
  struct Guess {
    Vector x;
    std::vector<bool> is_free;
    Matrix picks, follows;
  };
  enum class Reach { all, first_bound };

  int size() const { return static_cast<int>(p_.start.size()); }
  Vector left_over(const Vector& x) const { return p_.response * x + p_.start; }
  double residual(const Vector& x) const;
  double scale() const;
  bool solved() const {
    return left_ <= bounded_tolerance * scale() && left_ <= bounded_share * p_.start.cwiseAbs().maxCoeff();
  }

  void take(const Vector& x);
  void keep_better(const Vector& x);
  void approach(double spring, int steps);
  void finish();
  void run_of_steps(double damping, Reach reach);
  Guess guess_from(const Vector& from) const;
  double step_fraction(const Guess& guess, const Vector& change) const;
  Vector newton_step(const Vector& from, double damping, Reach reach) const;

  const BoundedProblem& p_;
  const Vector own_;  // diagonal of K
  Vector bounded_;    // impulses of the approach, within bounds
  Vector pull_;       // extension of the springs (scaled multipliers)
  double spring_ = 1.0;
  Vector x_;     // best solution since the last approach
  double left_;  // residual of x_ [m/s]
};

/// Largest change of w that an unknown still needs within its bounds [m/s].
double Solver::residual(const Vector& x) const {
  const Vector w = left_over(x);
  double largest = 0.0;
  for (int i = 0; i < size(); ++i) {
    const double change = x[i] - within(x[i] - w[i] / own_[i], bounds_of(p_, x, i));
    largest = std::max(largest, own_[i] * std::fabs(change));
  }
  return largest;
}

/// The largest sum of the absolute terms of w; rounding is proportional to it [m/s].
double Solver::scale() const {
  const Vector sums = p_.response.cwiseAbs() * x_.cwiseAbs() + p_.start.cwiseAbs();
  return sums.maxCoeff();
}

void Solver::take(const Vector& x) {
  x_ = x;
  left_ = residual(x);
}

void Solver::keep_better(const Vector& x) {
  if (x.size() > 0 && residual(x) < left_) take(x);
}

void Solver::approach(double spring, int steps) {
  pull_ *= spring_ / spring;
  spring_ = spring;
  Matrix equations = p_.response;
  equations.diagonal() += spring * own_;
  equations.makeCompressed();
  const Factors factors(equations);
  if (factors.info() != Eigen::Success) return;
  const Vector stiffness = spring * own_;
  for (int step = 0; step < steps; ++step) {
    constexpr double beyond = 1.6;  // usual over-relaxation (Stellato et al. 2020)
    const Vector free = factors.solve(Vector(stiffness.cwiseProduct(bounded_ - pull_) - p_.start));
    const Vector ahead = beyond * free + (1.0 - beyond) * bounded_;
    for (int i = 0; i < size(); ++i) bounded_[i] = within(ahead[i] + pull_[i], bounds_of(p_, bounded_, i));
    pull_ += ahead - bounded_;
  }
  take(bounded_);
}

/// Sets the unknowns that would pass a bound to it.
Solver::Guess Solver::guess_from(const Vector& from) const {
  const Vector w = left_over(from);
  Guess guess{from, std::vector<bool>(size()), {}, {}};
  std::vector<int> column(size(), -1);               // of a free unknown among the free ones
  std::vector<Eigen::Triplet<double>> pick, follow;  // the free unknowns; all that change with one
  for (int i = 0; i < size(); ++i) {
    const double wanted = from[i] - w[i] / own_[i];
    const Bounds bounds = bounds_of(p_, from, i);
    const int normal = p_.normal[i];
    if (wanted > bounds.lower && wanted < bounds.upper) {
      guess.is_free[i] = true;
      column[i] = static_cast<int>(pick.size());
      pick.emplace_back(column[i], i, 1.0);
      follow.emplace_back(i, column[i], 1.0);
    } else if (normal == BoundedProblem::none) {
      guess.x[i] = within(wanted, bounds);
    } else {
      const bool above = wanted > 0.5 * (bounds.lower + bounds.upper);
      const double share = above ? p_.limit[i] : -p_.limit[i];
      guess.x[i] = share * guess.x[normal] + (above ? p_.spare[i].left : -p_.spare[i].right);
      if (column[normal] >= 0) follow.emplace_back(i, column[normal], share);
    }
  }
  const int count = static_cast<int>(pick.size());
  guess.picks.resize(count, size());
  guess.follows.resize(size(), count);
  guess.picks.setFromTriplets(pick.begin(), pick.end());
  guess.follows.setFromTriplets(follow.begin(), follow.end());
  return guess;
}

/// Largest step fraction, at most 1, that keeps all free unknowns within their bounds.
double Solver::step_fraction(const Guess& guess, const Vector& change) const {
  double share = 1.0;
  const auto keep_gap = [&](double gap, double growth) {
    if (growth < 0.0) share = std::min(share, std::max(gap, 0.0) / -growth);
  };
  for (int i = 0; i < size(); ++i) {
    if (!guess.is_free[i]) continue;
    const Bounds now = bounds_of(p_, guess.x, i), growth = growth_of_bounds(p_, change, i);
    keep_gap(guess.x[i] - now.lower, change[i] - growth.lower);
    keep_gap(now.upper - guess.x[i], growth.upper - change[i]);
  }
  return share;
}

/// One Newton step: solves w = 0 for the free unknowns, with `damping` times their diagonal added. Takes the full step,
/// or stops at the first bound. Returns an empty vector if the equations are singular.
Vector Solver::newton_step(const Vector& from, double damping, Reach reach) const {
  const Guess guess = guess_from(from);
  Vector x = guess.x;
  if (guess.picks.rows() > 0) {
    Matrix equations = guess.picks * p_.response * guess.follows;
    equations.diagonal() += damping * (guess.picks * own_);
    equations.makeCompressed();
    const Factors factors(equations);
    if (factors.info() != Eigen::Success) return {};
    const Vector change = -(guess.follows * Vector(factors.solve(Vector(guess.picks * left_over(x)))));
    x += (reach == Reach::first_bound ? step_fraction(guess, change) : 1.0) * change;
  }
  for (int i = 0; i < size(); ++i) x[i] = within(x[i], bounds_of(p_, x, i));
  return x;
}

/// Up to eight Newton steps from the best solution so far. The residual may rise before it falls.
void Solver::run_of_steps(double damping, Reach reach) {
  constexpr int most = 8;
  Vector x = x_;
  for (int step = 0; step < most && !solved(); ++step) {
    x = newton_step(x, damping, reach);
    if (x.size() == 0) return;
    keep_better(x);
  }
}

void Solver::finish() {
  constexpr double worth_it = 0.9;
  double before = 2.0 * left_;
  while (!solved() && left_ < worth_it * before) {
    before = left_;
    for (const double damping : {1e-10, 1e-13, 1e-8, 1e-6, 1e-4, 1e-2}) run_of_steps(damping, Reach::all);
    for (const double damping : {1e-10, 1e-13}) run_of_steps(damping, Reach::first_bound);
  }
}

BoundedSolution Solver::solve(int most_rounds) {
  int steps = 0;
  for (int round = 0; round < most_rounds; ++round) {
    finish();
    if (solved()) {
      for (int more = 0; more < 2; ++more)
        keep_better(newton_step(x_, 1e-10, Reach::all));  // costs little, gains digits
      return {x_, left_, steps, true};
    }
    const int more = round < 2 ? 20 : round < 6 ? 100 : 300;
    const double springs[] = {0.1, 0.03, 0.01, 0.003, 0.001};
    approach(round < 6 ? 0.1 : springs[round % 5], more);
    steps += more;
  }
  return {x_, left_, steps, false};
}

/// Solution of the regularised problem, and its largest violation [m/s].
struct Regularised {
  BoundedSolution solution;
  double violation = 0.0;
};

Regularised regularised(const BoundedProblem& problem, double term) {
  BoundedProblem regular = problem;
  const Vector own = problem.response.diagonal();
  regular.response.diagonal() += term * own;
  const BoundedSolution solution = solve(regular);
  return {solution, term * own.cwiseProduct(solution.x).maxCoeff()};
}

}  // namespace

BoundedSolution solve(const BoundedProblem& problem) {
  constexpr int most_rounds = 400;
  const BoundedSolution solution = Solver(problem).solve(most_rounds);
  if (solution.found) return solution;
  throw Error(ExitCode::numerical_stop,
              "the reference engine found no impulses for " + std::to_string(problem.start.size()) +
                  " unknowns of touching bodies within " + std::to_string(solution.steps) +
                  " steps (with friction there may be none); try the engine cpu or a smaller numerics.time_step_s");
}

BoundedSolution solve_regularised(const BoundedProblem& problem) {
  constexpr double large_term = 1e-4, small_term = 1e-6;
  constexpr int few_rounds = 20;
  const Regularised first = regularised(problem, large_term), second = regularised(problem, small_term);
  // in a feasible problem the smaller term has a hundredth of the violation
  if (second.violation > 0.5 * first.violation) return first.solution;
  const BoundedSolution exact = Solver(problem).solve(few_rounds);
  return exact.found ? exact : second.solution;
}

}  // namespace gem::reference
