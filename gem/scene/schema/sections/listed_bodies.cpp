// Keys of [[floe]] and [[fixed]].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

std::vector<Option<FloeDef>> floe_keys() {
  OptionTable<FloeDef> t;
  t.outline("outline_m", {-1e3, 1e3}, "corners in body coordinates, any origin, either direction",
            GEM_FIELD(outline_m));
  t.pair("position_m", "m", place_range, "where the outline's origin stands", GEM_FIELD(position_m));
  t.number("angle_rad", "rad", {-6.3, 6.3}, "rotation about the outline's origin", GEM_FIELD(angle_rad),
           "one turn; 45 degrees are 0.785");
  t.pair("velocity_m_per_s", "m/s", speed_range, "velocity at the start", GEM_FIELD(velocity_m_per_s));
  t.number("spin_rad_per_s", "rad/s", spin_range, "spin at the start", GEM_FIELD(spin_rad_per_s));
  t.number("thickness_m", "m", thickness_range, "thickness", GEM_FIELD(thickness_m));
  return t.options;
}

std::vector<Option<FixedDef>> fixed_keys() {
  OptionTable<FixedDef> t;
  t.outline("outline_m", place_range, "corners in world coordinates, either direction", GEM_FIELD(outline_m));
  return t.options;
}

}  // namespace gem::sections
