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

/// What of a repair is done in this time step: none of the body's points goes farther than `reach` [m], the rest waits.
/// Where the iterations stop short of an answer, or a contact that held a wedged floe is gone, the shifts that they
/// leave are large; a floe that follows them jumps into neighbours that no contact has seen coming.
GEM_HD inline BodyRepair within_reach(const BodyRepair& repair, double radius, double reach) {
  const double farthest = length(repair.shift) + radius * larger(repair.turn, -repair.turn);
  if (!(farthest > reach)) return repair;
  const double share = reach / farthest;
  return {share * repair.shift, share * repair.turn};
}

}  // namespace gem
