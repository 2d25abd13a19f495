// The platform in a substep: the contacts have pushed it, then all other loads act as in a time step of that length.
#pragma once

#include <vector>

#include "gem/engine/step/solo_stages.h"

namespace gem {

/// `of_substep`: constants of a time step as long as the substep; `pushed`: the platform's speed after the contacts.
/// Returns the angle by which it has turned [rad]; its outline stays as it was.
inline double platform_substep(FieldState& f, const StepConstants& of_substep, PlatformSpeed pushed) {
  const Events& e = of_substep.events;
  Bodies& b = f.bodies;
  const PlatformSpeed before{b.velocity[0], b.spin[0]};
  b.velocity[0] = pushed.velocity;
  b.spin[0] = pushed.spin;
  take_water_along(e, moved_platform(f), before);
  platform_loads_before(f, e);
  const double spin = b.spin[0];
  platform_loads_after(f, e, spin);
  const double angle = of_substep.dt * spin;
  if (angle != 0.0) {
    b.rotation[0] = turned(b.rotation[0], angle);
    f.turn_travel[0] += magnitude(angle);
  }
  platform_loads_last(f, e);
  return angle;
}

/// Marks the sides of the platform's pieces that lie inside the whole, and corners that are none of it.
void find_hidden(const FieldState& f, std::vector<std::uint8_t>& hidden_side, std::vector<std::uint8_t>& no_corner);

}  // namespace gem
