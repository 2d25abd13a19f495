// Keys of [ice] and [[ice.class]].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_ice(SceneTable& t) {
  t.number("ice.density_kg_per_m3", "kg/m3", density_range, "density of the ice", GEM_FIELD(ice.density_kg_per_m3));
  t.number("ice.crushing_pressure_Pa", "Pa", {1e3, 1e9}, "crushing pressure P0 on 1 m2",
           GEM_FIELD(ice.crushing_pressure_Pa));
  t.number("ice.pressure_area_exponent", "", {-0.9, 0.5}, "exponent of pressure on contact area",
           GEM_FIELD(ice.pressure_area_exponent));
  const std::string why =
      "ice has less friction, and above this a sliding corner of a rigid body may have no solution (Painleve)";
  t.number("ice.friction_ice", "", {0.0, 1.5}, "friction of floe on floe and floe on boundary",
           GEM_FIELD(ice.friction_ice), why);
  t.number("ice.friction_structure", "", {0.0, 1.5}, "friction of floe on platform", GEM_FIELD(ice.friction_structure),
           why);
}

std::vector<Option<IceClassDef>> ice_class_keys() {
  OptionTable<IceClassDef> t;
  t.text("name", "name of the class", GEM_FIELD(name));
  t.number("thickness_m", "m", thickness_range, "thickness of its floes", GEM_FIELD(thickness_m));
  t.number("tenths", "", {0.0, 10.0},
           "weight of the class: its share of the ice area is tenths over the sum of all tenths; the concentration is "
           "set by "
           "floes.count",
           GEM_FIELD(tenths));
  return t.options;
}

}  // namespace gem::sections
