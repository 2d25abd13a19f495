// Keys of [current].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_current(SceneTable& t) {
  t.pair("current.velocity_m_per_s", "m/s", speed_range, "velocity of the water, uniform",
         GEM_FIELD(current.velocity_m_per_s));
  t.opt_in = true;
  const OptionColumn x = {"x", "m/s", speed_range}, y = {"y", "m/s", speed_range},
                     speed = {"speed", "m/s", {0.0, 10.0}};
  const Range phase = {-12.6, 12.6};
  t.table("current.velocity_table", {time_column(), x, y},
          "velocity of the water over time, linear between the rows, constant before and after them; in place of "
          "velocity_m_per_s",
          GEM_FIELD(drive.current_velocity));
  t.table("current.direction_table", {time_column(), speed, direction_column()},
          "the same by speed and direction, each linear between the rows; the direction counts from x "
          "counter-clockwise, and is where the water flows to",
          GEM_FIELD(drive.current_direction));
  t.table("current.tide_table",
          {{"period", "s", {60.0, 1e8}},
           {"amplitude_x", "m/s", speed_range},
           {"phase_x", "rad", phase},
           {"amplitude_y", "m/s", speed_range},
           {"phase_y", "rad", phase}},
          "harmonics that are added to the current: amplitude cos(2 pi time / period - phase)", GEM_FIELD(drive.tide));
}

}  // namespace gem::sections
