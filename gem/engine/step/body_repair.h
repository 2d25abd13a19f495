// Position repair of one body in a coupled time step.
#pragma once

#include "gem/base/choose.h"
#include "gem/base/macros.h"
#include "gem/base/vec2.h"

namespace gem {

struct BodyRepair {
  Vec2 shift;         // [m]
  double turn = 0.0;  // [rad]
};

/// The part of a repair that is applied in this time step: no point of the body moves farther than `reach` [m]. The
/// rest waits for later steps. The solver leaves large shifts if it stops before it converges, or if a contact that
/// held a wedged floe is gone. Without the limit such a floe would jump into neighbours that no contact has detected.
GEM_HD inline BodyRepair within_reach(const BodyRepair& repair, double radius, double reach) {
  const double farthest = length(repair.shift) + radius * larger(repair.turn, -repair.turn);
  if (!(farthest > reach)) return repair;
  const double share = reach / farthest;
  return {share * repair.shift, share * repair.turn};
}

}  // namespace gem
