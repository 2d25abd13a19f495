// Keys of [wind].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_wind(SceneTable& t) {
  t.opt_in = true;
  const Range wind = {-100.0, 100.0};
  t.pair("wind.velocity_m_per_s", "m/s", wind, "velocity of the wind 10 m above the ice, uniform; 0: none",
         GEM_FIELD(wind.velocity_m_per_s));
  t.table("wind.velocity_table", {time_column(), {"x", "m/s", wind}, {"y", "m/s", wind}},
          "velocity of the wind over time, as current.velocity_table", GEM_FIELD(drive.wind_velocity));
  t.table("wind.direction_table", {time_column(), {"speed", "m/s", {0.0, 100.0}}, direction_column()},
          "the same by speed and direction, as current.direction_table: where the wind blows to",
          GEM_FIELD(drive.wind_direction));
  t.number("wind.density_kg_per_m3", "kg/m3", {0.5, 2.0}, "density of the air", GEM_FIELD(wind.density_kg_per_m3));
  t.number("wind.skin_coefficient", "", {0.0, 0.1}, "skin drag of the wind on the area of a floe",
           GEM_FIELD(wind.skin_coefficient));
  t.number("wind.form_coefficient", "", {0.0, 10.0}, "form drag of the wind on sqrt(area) x freeboard of a floe",
           GEM_FIELD(wind.form_coefficient));
  t.number("wind.platform_area_m2", "m2", {0.0, 1e6},
           "projected area of the platform above the water; 0: no wind on it", GEM_FIELD(wind.platform_area_m2));
  t.number("wind.platform_coefficient", "", {0.0, 10.0}, "drag coefficient of the platform on that area",
           GEM_FIELD(wind.platform_coefficient));
}

}  // namespace gem::sections
