// Keys of [platform] and [[platform.piece]].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {
namespace {

void add_platform_outline(SceneTable& t) {
  const Range extent = {0.1, 1e4};
  t.choice(
      "platform.outline", {"regular", "ship", "listed", "pieces"},
      "regular: polygon of sides and diameter_m; ship: waterline of a drillship, its bow at -x; listed: outline_m; "
      "pieces: the convex pieces of [[platform.piece]], which move together",
      GEM_FIELD(platform.outline));
  t.number("platform.length_m", "m", extent, "length over all (outline = \"ship\")", GEM_FIELD(platform.length_m));
  t.number("platform.beam_m", "m", extent, "beam (outline = \"ship\")", GEM_FIELD(platform.beam_m));
  t.number("platform.bow_length_m", "m", {0.0, 1e4},
           "from the stem to where the sides are parallel; 0: a flat bow (outline = \"ship\")",
           GEM_FIELD(platform.bow_length_m));
  t.number("platform.stern_length_m", "m", {0.0, 1e4},
           "from the end of the parallel sides to the transom, which is half the beam wide; 0: all of it parallel "
           "(outline = \"ship\")",
           GEM_FIELD(platform.stern_length_m));
  t.outline("platform.outline_m", {-1e4, 1e4},
            "corners of a convex outline in body axes, either direction; the platform's centre is their centroid "
            "(outline = \"listed\")",
            GEM_FIELD(platform.outline_m), platform_corners_maximum);
  t.number("platform.inertia_kg_m2", "kg m2", {0.0, 1e20},
           "moment of inertia about the centroid; 0: that of mass_kg spread evenly over the outline",
           GEM_FIELD(platform.inertia_kg_m2));
  t.flag("platform.fixed", "whether the platform stands still: a fixed structure, whose loads are the forces on it",
         GEM_FIELD(platform.fixed));
}

}  // namespace

void add_platform(SceneTable& t) {
  t.flag("platform.present", "whether there is a platform", GEM_FIELD(platform.present));
  t.integer("platform.sides", {3.0, 256.0}, "sides of the regular polygon", GEM_FIELD(platform.sides));
  t.number("platform.diameter_m", "m", {0.1, 1e4}, "diameter of the circle through the corners",
           GEM_FIELD(platform.diameter_m));
  t.number("platform.mass_kg", "kg", {1.0, 1e15}, "total inertia", GEM_FIELD(platform.mass_kg));
  t.pair("platform.anchor_m", "m", place_range, "rest position of the mooring", GEM_FIELD(platform.anchor_m));
  t.pair("platform.start_offset_m", "m", {-1e3, 1e3}, "offset from the anchor at the start",
         GEM_FIELD(platform.start_offset_m));
  t.pair("platform.start_velocity_m_per_s", "m/s", speed_range, "velocity at the start",
         GEM_FIELD(platform.start_velocity_m_per_s));
  t.number("platform.start_yaw_rad", "rad", {-3.1416, 3.1416}, "yaw at the start, counter-clockwise",
           GEM_FIELD(platform.start_yaw_rad));
  t.number("platform.start_spin_rad_per_s", "rad/s", spin_range, "yaw rate at the start",
           GEM_FIELD(platform.start_spin_rad_per_s));
  t.choice("platform.yaw", {"free", "locked"}, "whether the platform may turn", GEM_FIELD(platform.yaw));
  t.opt_in = true;
  add_platform_outline(t);
}

std::vector<Option<PlatformPieceDef>> platform_piece_keys() {
  OptionTable<PlatformPieceDef> t;
  t.outline("outline_m", {-1e4, 1e4},
            "corners of one convex piece in the axes of the platform, either direction; all pieces have one origin; "
            "pieces may touch but not overlap; the platform's centre is the centroid of all (platform.outline = "
            "\"pieces\")",
            GEM_FIELD(outline_m), platform_corners_maximum);
  return t.options;
}

}  // namespace gem::sections
