// Keys of [transit].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_transit(SceneTable& t) {
  t.opt_in = true;
  t.number("transit.speed_m_per_s", "m/s", {0.0, 10.0},
           "speed at which the platform, a ship, is led along a path by a tow that holds it; 0: no transit",
           GEM_FIELD(transit.speed_m_per_s));
  t.number("transit.course_rad", "rad", {-6.3, 6.3},
           "direction in which a path without way points leads; 3.14 is where the bow of a ship at yaw 0 points to",
           GEM_FIELD(transit.course_rad));
  t.table("transit.way_point_table", {{"x", "m", place_range}, {"y", "m", place_range}},
          "way points of the path, which begins where the platform starts and goes straight on after the last; the "
          "yaw turns with the course",
          GEM_FIELD(transit.way_point_m));
  t.number("transit.turn_radius_m", "m", {1.0, 1e5}, "radius of the arcs at way points",
           GEM_FIELD(transit.turn_radius_m));
}

}  // namespace gem::sections
