// A linear complementarity problem with bounds that may depend on other unknowns, and a solver without warm start.
//
//   w = K x + b        lower <= x <= upper
//   w >= 0 where x = lower,   w <= 0 where x = upper,   w = 0 in between
//
//   x  impulses [N s]       w  velocity after the impulses minus its target [m/s]
//   K  response [1/kg]      b  w without impulses [m/s]
//
// The position repair is the same problem with x in kg m and w, b in m.
// A normal impulse lies in [0, cap]. A tangential impulse lies in [-mu P_n - right, mu P_n + left], with P_n its normal
// impulse, and left and right the spare friction of the last time step (friction_memory.h).
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "gem/events/friction_memory.h"

namespace gem::reference {

struct BoundedProblem {
  static constexpr int none = -1;
  Eigen::SparseMatrix<double, Eigen::RowMajor> response;  // K
  Eigen::VectorXd start;                                  // b
  Eigen::VectorXd limit;                                  // normal: cap (infinity: none) [N s]; tangential: mu [-]
  std::vector<int> normal;           // tangential: index of its normal impulse, which comes before it; else `none`
  std::vector<SpareFriction> spare;  // tangential: beyond mu P_n [N s]
};

struct BoundedSolution {
  Eigen::VectorXd x;
  double residual = 0.0;  // largest |w| that is left, past what the bounds allow [m/s]
  int steps = 0;          // of the approach
  bool found = false;     // the residual is at rounding level
};

/// Accepted residual, relative to the largest sum of absolute terms of w: rounding level ...
constexpr double bounded_tolerance = 1e-13;
/// ... and relative to the largest |b|. The second bound rejects huge impulses that cancel each other.
constexpr double bounded_share = 1e-8;

/// Solves the problem. Throws Error(numerical_stop) if it cannot.
BoundedSolution solve(const BoundedProblem& problem);

/// As solve(), for problems that may be infeasible, such as bodies in a box that is too small for them. A small
/// multiple of the diagonal of K is added to K, which spreads the violation over all unknowns.
BoundedSolution solve_regularised(const BoundedProblem& problem);

}  // namespace gem::reference
