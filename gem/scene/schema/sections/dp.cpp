// Keys of [dp] and [[dp.thruster]].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_dp(SceneTable& t) {
  t.opt_in = true;
  const Range period = {1.0, 1e5};
  t.pair("dp.position_m", "m", place_range, "set point of the platform's centre; it acts with a [[dp.thruster]]",
         GEM_FIELD(dp.position_m));
  t.number("dp.yaw_rad", "rad", {-3.1416, 3.1416}, "set point of the yaw", GEM_FIELD(dp.yaw_rad));
  t.flag(
      "dp.follows_drift",
      "whether yaw_rad counts from the direction that the water flows to; then a bow that points to -x meets the ice",
      GEM_FIELD(dp.follows_drift));
  t.number("dp.surge_period_s", "s", period, "natural period that the control gives to the surge",
           GEM_FIELD(dp.surge_period_s));
  t.number("dp.sway_period_s", "s", period, "the same of the sway", GEM_FIELD(dp.sway_period_s));
  t.number("dp.yaw_period_s", "s", period, "the same of the yaw", GEM_FIELD(dp.yaw_period_s));
  t.number("dp.damping_ratio", "", {0.0, 10.0}, "fraction of critical damping that the control gives",
           GEM_FIELD(dp.damping_ratio));
  t.number("dp.integral_time_s", "s", {0.0, 1e6}, "proportional over integral gain; 0: no integral",
           GEM_FIELD(dp.integral_time_s));
  t.table("dp.gain_table",
          {{"proportional", "N/m", {0.0, 1e15}},
           {"derivative", "N s/m", {0.0, 1e15}},
           {"integral", "N/(m s)", {0.0, 1e15}}},
          "gains in place of periods, damping_ratio and integral_time_s: a row for surge, one for sway, one for yaw, "
          "which has moments and rad",
          GEM_FIELD(dp.gains));
  t.number("dp.filter_time_s", "s", {0.0, 1e4},
           "time constant of the low-pass of position, yaw and their rates; 0: none", GEM_FIELD(dp.filter_time_s));
}

std::vector<Option<ThrusterDef>> thruster_keys() {
  OptionTable<ThrusterDef> t;
  t.choice("kind", {"azimuth", "fixed", "tunnel"},
           "azimuth: thrust in any direction; fixed: along direction_rad; tunnel: athwart, to both sides",
           GEM_FIELD(kind));
  t.pair("position_m", "m", {-1e3, 1e3}, "place, from the platform's centre at yaw 0", GEM_FIELD(position_m));
  t.number("direction_rad", "rad", {-6.3, 6.3}, "direction of the thrust of a fixed one at yaw 0",
           GEM_FIELD(direction_rad));
  t.number("maximum_N", "N", {1.0, 1e9}, "largest thrust", GEM_FIELD(maximum_N));
  t.number("reverse_share", "", {0.0, 1.0}, "largest thrust of a fixed one backwards, over maximum_N",
           GEM_FIELD(reverse_share));
  t.number("rate_N_per_s", "N/s", {0.0, 1e9}, "largest change of the thrust; 0: it changes at once",
           GEM_FIELD(rate_N_per_s));
  return t.options;
}

}  // namespace gem::sections
