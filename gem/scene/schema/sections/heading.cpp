// Keys of [heading].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_heading(SceneTable& t) {
  t.opt_in = true;
  t.number("heading.moment_N_m", "N m", {0.0, 1e15},
           "largest moment of a heading control that turns the platform's bow against the current; 0: none",
           GEM_FIELD(heading.moment_N_m));
  t.number("heading.damping_N_m_s", "N m s", {0.0, 1e16}, "its damping of the yaw rate",
           GEM_FIELD(heading.damping_N_m_s));
}

}  // namespace gem::sections
