#include "gem/engine/solver/iteration_control.h"

#include <cmath>

namespace gem {

std::vector<float> momentum_coefficients(std::int64_t most) {
  // A time step does not start at 1, as the warm start is close to the answer. With 4 the 99.9 % overlap is 15 to 26 %
  // lower (validation/solver_study.md, start of the acceleration).
  constexpr double of_a_step = 4.0, from_nothing = 1.0;
  std::vector<float> coefficients;
  for (double theta : {of_a_step, from_nothing})
    for (std::int64_t k = 0; k < most; ++k) {
      const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * theta * theta));
      coefficients.push_back(static_cast<float>((theta - 1.0) / next));
      theta = next;
    }
  return coefficients;
}

}  // namespace gem
