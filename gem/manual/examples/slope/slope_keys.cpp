// Keys of [slope].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_slope(SceneTable& t) {
  t.opt_in = true;
  t.pair("slope.rise", "", {-1e-3, 1e-3}, "rise of the sea surface over distance in x and in y; 0: level",
         GEM_FIELD(slope.rise));
}

}  // namespace gem::sections
