// Keys of [breakup].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_breakup(SceneTable& t) {
  t.opt_in = true;
  t.integer("breakup.maximum_pieces", {0.0, 1e6},
            "most pieces that floes which split in their plane give in a run, two for each split; 0: floes stay whole",
            GEM_FIELD(breakup.maximum_pieces));
  t.number("breakup.fracture_toughness_Pa_sqrt_m", "Pa m^0.5", {1e3, 1e7}, "fracture toughness of the ice",
           GEM_FIELD(breakup.fracture_toughness_Pa_sqrt_m));
  t.number("breakup.elastic_modulus_Pa", "Pa", {1e7, 1e11}, "elastic modulus of the ice, for the energy of cracks",
           GEM_FIELD(breakup.elastic_modulus_Pa));
  t.number("breakup.wedge_ratio", "", {0.01, 10.0},
           "force that opens the crack over the force of the contact: 1 / (2 tan t) for a wedge of half angle t",
           GEM_FIELD(breakup.wedge_ratio));
  t.number("breakup.load_time_s", "s", {1e-3, 60.0}, "a floe splits by the mean force of a contact over this time",
           GEM_FIELD(breakup.load_time_s));
  t.number("breakup.minimum_size_m", "m", floe_size_range, "size, the root of the area, of the smallest piece",
           GEM_FIELD(breakup.minimum_size_m));
}

}  // namespace gem::sections
