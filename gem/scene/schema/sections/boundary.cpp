// Keys of [boundary].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_boundary(SceneTable& t) {
  t.flag("boundary.present", "whether two fixed bodies bound the channel", GEM_FIELD(boundary.present));
  t.number("boundary.inlet_x_m", "m", {-1e6, 0.0, false, true}, "x of the upstream end of the boundary",
           GEM_FIELD(boundary.inlet_x_m));
  t.number("boundary.inlet_width_m", "m", extent_range, "width of the channel upstream",
           GEM_FIELD(boundary.inlet_width_m));
  t.number("boundary.taper_start_x_m", "m", place_range,
           "x where the channel begins to narrow; at or upstream of the inlet the whole channel narrows",
           GEM_FIELD(boundary.taper_start_x_m));
  t.number("boundary.gap_m", "m", extent_range, "width of the channel from x = 0 on", GEM_FIELD(boundary.gap_m));
  t.number("boundary.outlet_x_m", "m", {0.0, 1e6, true}, "x of the downstream end of the boundary",
           GEM_FIELD(boundary.outlet_x_m));
}

}  // namespace gem::sections
