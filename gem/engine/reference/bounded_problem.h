// A linear complementarity problem whose bounds may follow other unknowns, and its solver: plain, without memory of
// earlier problems, solved until it is solved.
//
//   w = K x + b        lower <= x <= upper
//   w >= 0 where x = lower,   w <= 0 where x = upper,   w = 0 in between
//
//   x  impulses [N s]       w  what is left of the velocities that they have to bring about [m/s]
//   K  response [1/kg]      b  the same without impulses [m/s]
//
// A normal impulse lies in [0, cap]; a tangential one in [-mu P_n, mu P_n] of its normal impulse P_n.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace gem::reference {

struct BoundedProblem {
  static constexpr int none = -1;
  Eigen::SparseMatrix<double, Eigen::RowMajor> response;  // K
  Eigen::VectorXd start;                                  // b
  Eigen::VectorXd limit;    // a normal's cap (infinity: none) [N s]; a tangential's mu [-]
  std::vector<int> normal;  // of a tangential: the unknown of its normal impulse, which comes before; else `none`
};

struct BoundedSolution {
  Eigen::VectorXd x;
  double residual = 0.0;  // largest |w| that is left, past what the bounds allow [m/s]
  int steps = 0;          // of the approach
  bool found = false;     // what is left is rounding
};

/// What is left of w at the end is below this share of the largest sum of the sizes of its terms, which is what
/// rounding is a share of ...
constexpr double bounded_tolerance = 1e-13;
/// ... and below this share of the largest |b|: impulses without end that cancel are no answer.
constexpr double bounded_share = 1e-8;

/// Solves the problem. Throws Error(numerical_stop) if it cannot.
BoundedSolution solve(const BoundedProblem& problem);

/// The same where there may be no answer, as where bodies lie in a box too small for them: what cannot be met is shared
/// out, every unknown answering to itself a little more than it does.
BoundedSolution solve_or_yield(const BoundedProblem& problem);

}  // namespace gem::reference
