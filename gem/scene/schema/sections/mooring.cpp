// Keys of [mooring].
#include "gem/scene/schema/sections/sections.h"

namespace gem::sections {
namespace {

void add_laws(SceneTable& t) {
  const OptionColumn offset = {"offset", "m", {0.0, 1e4}}, force = {"force", "N", {0.0, 1e12}};
  t.choice("mooring.law", {"linear", "table", "catenary"},
           "linear: stiffness_N_per_m and damping_ratio; table: force_table or direction_table; catenary: line_table",
           GEM_FIELD(mooring.law));
  t.table(
      "mooring.force_table", {offset, force},
      "force towards the anchor over the offset, the same in every direction: from 0 where the mooring tightens on, "
      "linear between the rows; before the first row it is slack, beyond the last the last slope goes on",
      GEM_FIELD(mooring_design.force));
  t.table("mooring.direction_table", {direction_column(), offset, force},
          "the same by direction of the offset, at least three directions around a turn; the rows of a direction stand "
          "together, directions rise. Between two directions the energy is interpolated",
          GEM_FIELD(mooring_design.direction));
  t.table(
      "mooring.line_table",
      {{"anchor_x", "m", place_range},
       {"anchor_y", "m", place_range},
       {"fairlead_x", "m", {-1e3, 1e3}},
       {"fairlead_y", "m", {-1e3, 1e3}},
       {"length", "m", {1.0, 1e5}},
       {"weight", "N/m", {1.0, 1e6}},
       {"stiffness", "N", {1e4, 1e13}},
       {"strength", "N", {0.0, 1e12}}},
      "lines from an anchor to a fairlead, which is given from the platform's centre at yaw 0: length without load, "
      "weight in water, axial stiffness EA, and strength: a line with more tension "
      "breaks (0: never); a case that starts with a broken line is refused",
      GEM_FIELD(mooring_design.lines));
  t.number("mooring.line_height_m", "m", {0.0, 1e4}, "height of the fairleads above the anchors on the level seabed",
           GEM_FIELD(mooring_design.line_height_m));
  t.number("mooring.damping_N_s_per_m", "N s/m", {0.0, 1e12}, "linear damping of surge and sway, with any law; 0: none",
           GEM_FIELD(mooring.damping_N_s_per_m));
  t.number("mooring.yaw_stiffness_N_m_per_rad", "N m/rad", {0.0, 1e15},
           "stiffness of the yaw about 0, with any law; 0: none", GEM_FIELD(mooring.yaw_stiffness_N_m_per_rad));
  t.number("mooring.yaw_damping_N_m_s_per_rad", "N m s/rad", {0.0, 1e15}, "linear damping of the yaw; 0: none",
           GEM_FIELD(mooring.yaw_damping_N_m_s_per_rad));
}

}  // namespace

void add_mooring(SceneTable& t) {
  t.number("mooring.stiffness_N_per_m", "N/m", {0.0, 1e15}, "stiffness in x and in y; 0: unmoored",
           GEM_FIELD(mooring.stiffness_N_per_m));
  t.number("mooring.damping_ratio", "", {0.0, 1.0, false, true}, "fraction of critical damping",
           GEM_FIELD(mooring.damping_ratio));
  t.opt_in = true;
  add_laws(t);
}

}  // namespace gem::sections
