// Keys of [water].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_water(SceneTable& t) {
  t.number("water.density_kg_per_m3", "kg/m3", density_range, "density of the water",
           GEM_FIELD(water.density_kg_per_m3));
  t.choice("water.drag_law", {"none", "quadratic", "linear"}, "drag law of the floes in the water",
           GEM_FIELD(water.drag_law));
  t.number("water.form_coefficient", "", {0.0, 100.0}, "form drag C_f, on sqrt(area) x draft (quadratic law)",
           GEM_FIELD(water.form_coefficient));
  t.number("water.skin_coefficient", "", {0.0, 10.0}, "skin drag C_s, on the area (quadratic law)",
           GEM_FIELD(water.skin_coefficient));
  t.number("water.linear_time_s", "s", {0.0, 1e9, true}, "time constant of the linear law",
           GEM_FIELD(water.linear_time_s));
  t.flag("water.spin_drag", "whether the water also slows the spin of the floes", GEM_FIELD(water.spin_drag));
  t.opt_in = true;
  t.number("water.turning_rad", "rad", {-0.7, 0.7},
           "angle by which the drag of the water is turned from the slip, counter-clockwise (quadratic law); about 0.4 "
           "on the northern hemisphere where the current is that below the boundary layer of the ice",
           GEM_FIELD(water.turning_rad));
}

}  // namespace gem::sections
