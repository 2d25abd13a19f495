// Keys of [output].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_output(SceneTable& t) {
  t.number("output.platform_interval_s", "s", {0.0, 1e6, true},
           "interval of the platform record; if not given, the smallest multiple of the time step from 0.1 s on",
           GEM_FIELD(output.platform_interval_s));
  t.number("output.floes_interval_s", "s", {0.0, 1e8, true}, "interval of the floe frames",
           GEM_FIELD(output.floes_interval_s));
  t.number("output.force_window_s", "s", {0.0, 1e6, true}, "averaging window of the reported ice force",
           GEM_FIELD(output.force_window_s));
  t.flag("output.platform_events", "whether every event on the platform is recorded",
         GEM_FIELD(output.platform_events));
  t.flag("output.contact_forces",
         "whether every floe frame records the forces between touching bodies (engines cpu, cuda and reference)",
         GEM_FIELD(output.contact_forces));
  t.number("output.event_speed_m_per_s", "m/s", {0.0, 10.0},
           "first touches that close more slowly count as static load: in the force channels, not in the event list",
           GEM_FIELD(output.event_speed_m_per_s));
  t.number(
      "output.hit_release_s", "s", {0.0, 1e6},
      "a floe that has not pressed on the platform for this long hits anew; 0: every time step is a hit of its own",
      GEM_FIELD(output.hit_release_s));
  t.number("output.retire_x_m", "m", place_range, "a floe whose centre passes this x is retired",
           GEM_FIELD(output.retire_x_m));
  t.opt_in = true;
  t.flag("output.side_loads",
         "whether every platform sample records the impulse of the ice on each side of the outline",
         GEM_FIELD(output.side_loads));
  t.flag("output.line_tensions",
         "whether every platform sample records the largest tension of each mooring line since the last",
         GEM_FIELD(output.line_tensions));
}

}  // namespace gem::sections
