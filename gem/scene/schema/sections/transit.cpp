// Keys of [transit].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_transit(SceneTable& t) {
  t.opt_in = true;
  t.number("transit.speed_m_per_s", "m/s", {0.0, 10.0},
           "speed at which the platform, a ship, is led along a path by a tow that holds it; 0 without a thrust: no "
           "transit. With a thrust: its speed at the start",
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
  t.number("transit.bollard_thrust_N", "N", {0.0, 1e9},
           "thrust at rest of a ship that runs free along a straight path: ice slows it down; 0: the ship is towed",
           GEM_FIELD(transit.bollard_thrust_N));
  t.number("transit.open_water_speed_m_per_s", "m/s", {0.0, 15.0},
           "speed of a ship that runs free in open water, where no thrust is left for ice",
           GEM_FIELD(transit.open_water_speed_m_per_s));
}

}  // namespace gem::sections
