// Keys of [added_mass].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_added_mass(SceneTable& t) {
  t.opt_in = true;
  t.number("added_mass.surge_kg", "kg", {0.0, 1e12},
           "mass of the water that moves with the platform along its x axis, beside platform.mass_kg",
           GEM_FIELD(added_mass.surge_kg));
  t.number("added_mass.sway_kg", "kg", {0.0, 1e12}, "the same across its x axis", GEM_FIELD(added_mass.sway_kg));
  t.number("added_mass.yaw_kg_m2", "kg m2", {0.0, 1e18},
           "moment of inertia of the water that turns with the platform, beside platform.inertia_kg_m2",
           GEM_FIELD(added_mass.yaw_kg_m2));
  t.number("added_mass.sway_yaw_kg_m", "kg m", {-1e15, 1e15},
           "sway force of a yaw acceleration, and yaw moment of a sway acceleration; its square is at most sway x yaw",
           GEM_FIELD(added_mass.sway_yaw_kg_m));
}

}  // namespace gem::sections
