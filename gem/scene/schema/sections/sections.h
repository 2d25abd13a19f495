// The sections of a case file, each in the file of its name. Ranges catch absurd values and mistaken units; the rules
// in gem/scene/checks compare options with each other.
#pragma once

#include <vector>

#include "gem/scene/schema/schema_builder.h"

namespace gem::sections {

using SceneTable = OptionTable<SceneDef>;

inline constexpr Range density_range = {1.0, 1e4};       // [kg/m3]
inline constexpr Range extent_range = {0.0, 1e6, true};  // of a length [m]
inline constexpr Range direction_range = {-12.6, 12.6};  // two turns [rad]
inline OptionColumn time_column() { return {"time", "s", {-1e9, 1e9}}; }
inline OptionColumn direction_column() { return {"direction", "rad", direction_range}; }

/// Each adds the keys of its section. Younger keys are opt-in: cases without them keep their text.
void add_run(SceneTable& t);
void add_current(SceneTable& t);
void add_water(SceneTable& t);
void add_ice(SceneTable& t);
void add_floes(SceneTable& t);
void add_boundary(SceneTable& t);
void add_platform(SceneTable& t);
void add_heading(SceneTable& t);
void add_mooring(SceneTable& t);
void add_platform_drag(SceneTable& t);
void add_contact(SceneTable& t);
void add_numerics(SceneTable& t);
void add_output(SceneTable& t);
void add_coriolis(SceneTable& t);
void add_wind(SceneTable& t);
void add_dp(SceneTable& t);
void add_breakup(SceneTable& t);
void add_transit(SceneTable& t);
void add_added_mass(SceneTable& t);

/// All sections in the order of a case file. A new one stands at the end.
inline constexpr void (*in_order[])(SceneTable&) = {
    add_run,     add_current, add_water,         add_ice,     add_floes,      add_boundary, add_platform,
    add_heading, add_mooring, add_platform_drag, add_contact, add_numerics,   add_output,   add_coriolis,
    add_wind,    add_dp,      add_breakup,       add_transit, add_added_mass,
};

/// The keys of an entry of [[ice.class]], [[platform.piece]], [[dp.thruster]], [[floe]] and [[fixed]].
std::vector<Option<IceClassDef>> ice_class_keys();
std::vector<Option<PlatformPieceDef>> platform_piece_keys();
std::vector<Option<ThrusterDef>> thruster_keys();
std::vector<Option<FloeDef>> floe_keys();
std::vector<Option<FixedDef>> fixed_keys();

}  // namespace gem::sections
