// Keys of [platform_drag].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_platform_drag(SceneTable& t) {
  t.flag("platform_drag.present", "whether the water drags the platform", GEM_FIELD(platform_drag.present));
  t.counts_with = {"platform_drag.law", "round"};
  t.number("platform_drag.coefficient", "", {0.0, 100.0}, "round: drag coefficient on diameter x draft",
           GEM_FIELD(platform_drag.coefficient));
  t.counts_with = {};
  t.number("platform_drag.draft_m", "m", {0.0, 1e3, true}, "draft of the platform", GEM_FIELD(platform_drag.draft_m));
  t.choice("platform_drag.water", {"still", "current"}, "whether the drag is relative to still water or to the current",
           GEM_FIELD(platform_drag.water));
  t.opt_in = true;
  t.choice("platform_drag.law", {"round", "by_axis"},
           "round: the same drag in all directions, none of the yaw; by_axis: drag of surge, sway and yaw, as a ship's",
           GEM_FIELD(platform_drag.law));
  t.opt_in = false;
  t.counts_with = {"platform_drag.law", "by_axis"};
  t.number("platform_drag.surge_coefficient", "", {0.0, 100.0},
           "by_axis: drag coefficient of surge on width x draft, 0.05 to 0.3 for a ship; 0: none",
           GEM_FIELD(platform_drag.surge_coefficient));
  t.number("platform_drag.sway_coefficient", "", {0.0, 100.0},
           "by_axis: drag coefficient of sway on length x draft, 0.5 to 1.0 for a ship; 0: none",
           GEM_FIELD(platform_drag.sway_coefficient));
  t.number("platform_drag.yaw_coefficient", "", {0.0, 100.0},
           "by_axis: drag coefficient of the strips of a hull that turns, 0.5 to 1.0 for a ship; 0: none",
           GEM_FIELD(platform_drag.yaw_coefficient));
}

}  // namespace gem::sections
