// The table's candidates.
#include "bench/solver_study/method.h"

namespace gem::bench {

std::vector<Candidate> candidates() {
  return {gathering("accelerated", {}),
          gathering("accelerated theta 1", {.begin = 1.0}),
          gathering("accelerated 0.7 shares", {.share = 0.7}),
          gathering("Jacobi shared masses", {.begin = 0.0}),
          gauss_seidel(),
          conjugate_gradient(),
          block_descent("block descent", 1.0, 1.0),
          block_descent("block descent stiffening", 1.05, 4.0),
          block_descent("block descent stiff", 1.5, 1e3)};
}

}  // namespace gem::bench
