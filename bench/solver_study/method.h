// The candidates: iterative methods for one time step's contact problem, all asked in the same way.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/solver_study/problem.h"

namespace gem::bench {

class Method {
 public:
  Method(const Problem& problem, Impulses start) : problem_(problem), impulses_(std::move(start)) {}
  virtual ~Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;

  /// One iteration: every point is visited once.
  virtual void pass() = 0;
  /// Steps of a pass that must wait for each other on a parallel machine. The platform's points are not coloured: they
  /// count as if they could be visited at once, which flatters the methods that go point by point.
  virtual std::int64_t phases_per_pass() const = 0;
  const Impulses& impulses() const { return impulses_; }

 protected:
  const Problem& problem_;
  Impulses impulses_;
};

struct Candidate {
  std::string name;
  std::function<std::unique_ptr<Method>(const Problem&, Impulses)> make;
};

/// How the gathering methods differ.
struct GatherOptions {
  double share = 1.0;       // of the points beyond the first among which a mass is shared out
  double begin = 4.0;       // theta of the acceleration; 0: none (Jacobi)
  bool anticipates = true;  // the repair also takes back what this time step's velocities leave
};

/// All points at once from the same velocities with shared masses: Jacobi, or accelerated.
Candidate gathering(const std::string& name, const GatherOptions& options);
/// Projected Gauss-Seidel, points ordered by colour.
Candidate gauss_seidel();
/// Nonsmooth nonlinear conjugate gradients around Gauss-Seidel (Silcowitz-Hansen, Niebe and Erleben 2010).
Candidate conjugate_gradient();
/// Augmented vertex block descent (Giles, Diaz and Yuksel 2025) for velocities: body after body by colour. Stiffness
/// begins at a point's own and grows by `growth` a pass, up to `stiffest` of it.
Candidate block_descent(const std::string& name, double growth, double stiffest);
/// Tridiagonal elimination: chains without friction only; throws std::invalid_argument for anything else.
Candidate chain_elimination();

/// The names and order of the tables; the chain's elimination is not among them.
std::vector<Candidate> candidates();

/// Points in an order in which points of one colour share no body but the platform or a fixed one.
struct PointOrder {
  std::vector<std::int32_t> point;
  std::int64_t colours = 0;
};
PointOrder colour_points(const Problem& problem);

}  // namespace gem::bench
