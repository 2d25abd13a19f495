// Keys of [platform_drag].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {

void add_platform_drag(SceneTable& t) {
  t.flag("platform_drag.present", "whether the water drags the platform", GEM_FIELD(platform_drag.present));
  t.number("platform_drag.coefficient", "", {0.0, 100.0}, "drag coefficient on diameter x draft",
           GEM_FIELD(platform_drag.coefficient));
  t.number("platform_drag.draft_m", "m", {0.0, 1e3, true}, "draft of the platform", GEM_FIELD(platform_drag.draft_m));
  t.choice("platform_drag.water", {"still", "current"}, "whether the drag is relative to still water or to the current",
           GEM_FIELD(platform_drag.water));
}

}  // namespace gem::sections
