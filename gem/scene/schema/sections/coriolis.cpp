// Keys of [coriolis].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_coriolis(SceneTable& t) {
  t.opt_in = true;
  t.number("coriolis.parameter_per_s", "1/s", {-1.46e-4, 1.46e-4},
           "Coriolis parameter of the floes, 2 x 7.2921e-5 x sin(latitude); 0: none",
           GEM_FIELD(coriolis.parameter_per_s), "that of the poles is 1.4584e-4");
}

}  // namespace gem::sections
