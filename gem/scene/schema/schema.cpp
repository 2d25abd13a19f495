// The table of options, section by section. Ranges catch absurd values and mistaken units. check_scene.cpp compares
// options with each other.
#include "gem/scene/schema/schema.h"

#include <algorithm>

#include "gem/scene/schema/schema_builder.h"
#include "gem/scene/toml/toml_text.h"

// Accessor of one member, for const and mutable scenes.
#define GEM_FIELD(member) \
  [](auto& s) -> auto& { return s.member; }

namespace gem {
namespace {

using SceneTable = OptionTable<SceneDef>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range density_range = {1.0, 1e4};
constexpr Range extent_range = {0.0, 1e6, true};

void add_run(SceneTable& t) {
  t.text("run.name", "name of the run, for its output file and in reports", GEM_FIELD(run.name));
  t.number("run.duration_s", "s", {0.0, 1e8}, "simulated time", GEM_FIELD(run.duration_s));
  t.integer("run.seed", {0.0, 9007199254740992.0}, "seed of all random numbers of the field", GEM_FIELD(run.seed));
}

void add_water(SceneTable& t) {
  t.pair("current.velocity_m_per_s", "m/s", speed_range, "velocity of the water, uniform",
         GEM_FIELD(current.velocity_m_per_s));
  t.number("water.density_kg_per_m3", "kg/m3", density_range, "density of the water",
           GEM_FIELD(water.density_kg_per_m3));
  t.choice("water.drag_law", {"none", "quadratic", "linear"}, "drag law of the floes in the water",
           GEM_FIELD(water.drag_law));
  t.number("water.form_coefficient", "", {0.0, 100.0}, "form drag C_f, on sqrt(area) x draft (quadratic law)",
           GEM_FIELD(water.form_coefficient));
  t.number("water.skin_coefficient", "", {0.0, 10.0}, "skin drag C_s, on the area (quadratic law)",
           GEM_FIELD(water.skin_coefficient));
  t.number("water.linear_time_s", "s", {0.0, 1e9, true}, "time constant of the linear law",
           GEM_FIELD(water.linear_time_s));
  t.flag("water.spin_drag", "whether the water also slows the spin of the floes", GEM_FIELD(water.spin_drag));
}

void add_ice(SceneTable& t) {
  t.number("ice.density_kg_per_m3", "kg/m3", density_range, "density of the ice", GEM_FIELD(ice.density_kg_per_m3));
  t.number("ice.crushing_pressure_Pa", "Pa", {1e3, 1e9}, "crushing pressure P0 on 1 m2",
           GEM_FIELD(ice.crushing_pressure_Pa));
  t.number("ice.pressure_area_exponent", "", {-0.9, 0.5}, "exponent of pressure on contact area",
           GEM_FIELD(ice.pressure_area_exponent));
  const std::string why =
      "ice has less friction, and above this a sliding corner of a rigid body may have no solution (Painleve)";
  t.number("ice.friction_ice", "", {0.0, 1.5}, "friction of floe on floe and floe on boundary",
           GEM_FIELD(ice.friction_ice), why);
  t.number("ice.friction_structure", "", {0.0, 1.5}, "friction of floe on platform", GEM_FIELD(ice.friction_structure),
           why);
}

void add_floe_source(SceneTable& t) {
  t.choice("floes.source", {"generated", "copied", "file", "listed"},
           "where the floes come from: a generated field, copies of a few shapes, a file, or [[floe]]",
           GEM_FIELD(floes.source));
  t.text("floes.path",
         "floe file for source = \"file\": .csv, .geojson or a run file (its floes at floes.time_s), relative to the "
         "case file",
         GEM_FIELD(floes.path));
  t.number("floes.time_s", "s", {0.0, 1e9},
           "for a run file: time of the recorded frame that the floes are taken from; 0: the start of that run",
           GEM_FIELD(floes.time_s));
  t.text("floes.sha256",
         "SHA-256 of the floes that floes.path must hold: a file with other floes is refused. Stored cases have it",
         GEM_FIELD(floes.sha256));
  t.opt_in = true;
  t.choice(
      "floes.concave", {"refuse", "cut", "hull"},
      "outlines of a .csv or .geojson file that are not convex, or have more than 20 corners: refuse the file, cut "
      "them into convex floes of the same area (not bonded to each other), or take their convex hull",
      GEM_FIELD(floes.concave));
  t.opt_in = false;
  t.integer("floes.count", {0.0, 1e7},
            "number of floes; it sets the concentration: count x (size_mean_m^2 + size_deviation_m^2) / "
            "(length_m x width_m)",
            GEM_FIELD(floes.count));
  t.opt_in = true;
  t.number("floes.concentration", "", {0.0, concentration_maximum},
           "share of the free water in the field that floes cover, from 0.05; it replaces floes.count; 0: not used. "
           "Above 0.75 the floes of a generated field are the cells of a mosaic",
           GEM_FIELD(floes.concentration));
  t.opt_in = false;
  t.number("floes.length_m", "m", extent_range, "length of the field along the current", GEM_FIELD(floes.length_m));
  t.number("floes.width_m", "m", extent_range, "width of the field", GEM_FIELD(floes.width_m));
  t.number("floes.start_x_m", "m", place_range, "x of the upstream end of the field", GEM_FIELD(floes.start_x_m));
}

void add_floe_sizes(SceneTable& t) {
  t.choice("floes.size_law", {"lognormal", "gamma"}, "distribution of sqrt(area), truncated to the limits",
           GEM_FIELD(floes.size_law));
  t.number("floes.size_minimum_m", "m", floe_size_range, "smallest sqrt(area)", GEM_FIELD(floes.size_minimum_m));
  t.number("floes.size_maximum_m", "m", floe_size_range, "largest sqrt(area)", GEM_FIELD(floes.size_maximum_m));
  t.number("floes.size_mean_m", "m", floe_size_range, "mean of sqrt(area)", GEM_FIELD(floes.size_mean_m));
  t.number("floes.size_deviation_m", "m", {0.0, 1000.0, true}, "standard deviation of sqrt(area)",
           GEM_FIELD(floes.size_deviation_m));
  t.number("floes.gap_m", "m", {0.0, 100.0, true}, "smallest distance between floes at the start",
           GEM_FIELD(floes.gap_m));
  t.choice("floes.placement", {"random", "tiled"}, "arrangement of the copies (source = \"copied\")",
           GEM_FIELD(floes.placement));
  t.integer("floes.shape_count", {1.0, 1e5}, "number of shapes that are copied (source = \"copied\")",
            GEM_FIELD(floes.shape_count));
  t.number("floes.tile_length_m", "m", extent_range, "approximate length of the repeated block (placement = \"tiled\")",
           GEM_FIELD(floes.tile_length_m));
  t.integer("floes.moved_floe", {-1.0, 1e7},
            "floe that is shifted by floes.moved_by_m: 0 is the nearest to platform.anchor_m, 1 the next; -1: none",
            GEM_FIELD(floes.moved_floe));
  t.pair("floes.moved_by_m", "m", {-1.0, 1.0},
         "shift of one floe's start position, to study how fast a disturbance grows", GEM_FIELD(floes.moved_by_m));
}

void add_boundary(SceneTable& t) {
  t.flag("boundary.present", "whether two fixed bodies bound the channel", GEM_FIELD(boundary.present));
  t.number("boundary.inlet_x_m", "m", {-1e6, 0.0, false, true}, "x of the upstream end of the boundary",
           GEM_FIELD(boundary.inlet_x_m));
  t.number("boundary.inlet_width_m", "m", extent_range, "width of the channel upstream",
           GEM_FIELD(boundary.inlet_width_m));
  t.number("boundary.taper_start_x_m", "m", place_range,
           "x where the channel begins to narrow; at or upstream of the inlet the whole channel narrows",
           GEM_FIELD(boundary.taper_start_x_m));
  t.number("boundary.gap_m", "m", extent_range, "width of the channel from x = 0 on", GEM_FIELD(boundary.gap_m));
  t.number("boundary.outlet_x_m", "m", {0.0, 1e6, true}, "x of the downstream end of the boundary",
           GEM_FIELD(boundary.outlet_x_m));
}

void add_platform_outline(SceneTable& t) {
  const Range extent = {0.1, 1e4};
  t.choice("platform.outline", {"regular", "ship", "listed"},
           "regular: polygon of sides and diameter_m; ship: waterline of a drillship, its bow at -x; listed: outline_m",
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

void add_heading(SceneTable& t) {
  t.number("heading.moment_N_m", "N m", {0.0, 1e15},
           "largest moment of a heading control that turns the platform's bow against the current; 0: none",
           GEM_FIELD(heading.moment_N_m));
  t.number("heading.damping_N_m_s", "N m s", {0.0, 1e16}, "its damping of the yaw rate",
           GEM_FIELD(heading.damping_N_m_s));
}

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
  add_heading(t);
  t.opt_in = false;
}

void add_mooring(SceneTable& t) {
  t.number("mooring.stiffness_N_per_m", "N/m", {0.0, 1e15}, "stiffness in x and in y; 0: unmoored",
           GEM_FIELD(mooring.stiffness_N_per_m));
  t.number("mooring.damping_ratio", "", {0.0, 1.0, false, true}, "fraction of critical damping",
           GEM_FIELD(mooring.damping_ratio));
  t.flag("platform_drag.present", "whether the water drags the platform", GEM_FIELD(platform_drag.present));
  t.number("platform_drag.coefficient", "", {0.0, 100.0}, "drag coefficient on diameter x draft",
           GEM_FIELD(platform_drag.coefficient));
  t.number("platform_drag.draft_m", "m", {0.0, 1e3, true}, "draft of the platform", GEM_FIELD(platform_drag.draft_m));
  t.choice("platform_drag.water", {"still", "current"}, "whether the drag is relative to still water or to the current",
           GEM_FIELD(platform_drag.water));
}

void add_contact(SceneTable& t) {
  t.choice("contact.solver", {"independent", "coupled"},
           "independent: each event of a time step once, as in the paper; coupled: all events together",
           GEM_FIELD(contact.solver));
  t.choice("contact.manifold", {"chord_middle", "chord_ends"}, "points where a contact acts",
           GEM_FIELD(contact.manifold));
  t.choice("contact.friction_law", {"one_step", "fixed_direction"},
           "one_step: Coulomb's law for the velocity after the event; fixed_direction: against the motion before it, "
           "as in the paper",
           GEM_FIELD(contact.friction_law));
  t.flag("contact.crushing_limit", "coupled: whether the crushing force of the smaller body limits an event",
         GEM_FIELD(contact.crushing_limit));
  t.number("contact.elastic_stiffness_N_per_m", "N/m", {0.0, 1e12},
           "independent: stiffness of the static event; 0: none", GEM_FIELD(contact.elastic_stiffness_N_per_m));
}

void add_numerics(SceneTable& t) {
  t.number("numerics.time_step_s", "s", {1e-6, 100.0}, "time step dt", GEM_FIELD(numerics.time_step_s));
  t.number("numerics.residual_tolerance", "", {0.0, 1.0, true},
           "coupled: iterations end when the residual is below this share of the current speed; with gradient 1e-05 if "
           "it is not given",
           GEM_FIELD(numerics.residual_tolerance));
  t.integer("numerics.iterations_maximum", {1.0, 1e5},
            "coupled: largest number of iterations in one time step; with gradient 32 if it is not given",
            GEM_FIELD(numerics.iterations_maximum));
  t.choice(
      "numerics.iteration", {"gradient", "splitting"},
      "coupled: splitting: iterations with a factored matrix, few to converge, each island by itself; gradient: cheap "
      "iterations, many to converge",
      GEM_FIELD(numerics.iteration));
  t.number("numerics.list_margin_m", "m", {0.0, 1e3}, "pairs closer than this are in the pair list",
           GEM_FIELD(numerics.list_margin_m));
  t.number("numerics.contact_reach", "steps", {0.0, 100.0},
           "coupled: faces that the current could close within this many time steps count as contacts; their floes "
           "move with "
           "their velocity after the events, not along the exact path of the drag",
           GEM_FIELD(numerics.contact_reach));
  t.number("numerics.repair_share", "", {0.0, 1.0}, "coupled: share of an overlap removed in one time step",
           GEM_FIELD(numerics.repair_share));
  t.number("numerics.repair_speed_m_per_s", "m/s", {0.0, 1e3}, "coupled: largest speed at which an overlap is removed",
           GEM_FIELD(numerics.repair_speed_m_per_s));
}

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
  t.opt_in = false;
}

const OptionColumn time_column = {"time", "s", {-1e9, 1e9}};
const OptionColumn direction_column = {"direction", "rad", {-12.6, 12.6}};  // two turns

void add_drive(SceneTable& t) {
  const OptionColumn x = {"x", "m/s", speed_range}, y = {"y", "m/s", speed_range},
                     speed = {"speed", "m/s", {0.0, 10.0}};
  const Range phase = {-12.6, 12.6};
  t.number("run.table_time_s", "s", time_column.range,
           "time in the tables of current, tide and wind at t = 0 of the run", GEM_FIELD(drive.start_time_s));
  t.table("current.velocity_table", {time_column, x, y},
          "velocity of the water over time, linear between the rows, constant before and after them; in place of "
          "velocity_m_per_s",
          GEM_FIELD(drive.current_velocity));
  t.table("current.direction_table", {time_column, speed, direction_column},
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
  t.number("water.turning_rad", "rad", {-0.7, 0.7},
           "angle by which the drag of the water is turned from the slip, counter-clockwise (quadratic law); about 0.4 "
           "on the northern hemisphere where the current is that below the boundary layer of the ice",
           GEM_FIELD(water.turning_rad));
  t.number("coriolis.parameter_per_s", "1/s", {-1.46e-4, 1.46e-4},
           "Coriolis parameter of the floes, 2 x 7.2921e-5 x sin(latitude); 0: none",
           GEM_FIELD(coriolis.parameter_per_s), "that of the poles is 1.4584e-4");
}

void add_wind(SceneTable& t) {
  const Range wind = {-100.0, 100.0};
  t.pair("wind.velocity_m_per_s", "m/s", wind, "velocity of the wind 10 m above the ice, uniform; 0: none",
         GEM_FIELD(wind.velocity_m_per_s));
  t.table("wind.velocity_table", {time_column, {"x", "m/s", wind}, {"y", "m/s", wind}},
          "velocity of the wind over time, as current.velocity_table", GEM_FIELD(drive.wind_velocity));
  t.table("wind.direction_table", {time_column, {"speed", "m/s", {0.0, 100.0}}, direction_column},
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

void add_mooring_laws(SceneTable& t) {
  const OptionColumn offset = {"offset", "m", {0.0, 1e4}}, force = {"force", "N", {0.0, 1e12}};
  t.choice("mooring.law", {"linear", "table", "catenary"},
           "linear: stiffness_N_per_m and damping_ratio; table: force_table or direction_table; catenary: line_table",
           GEM_FIELD(mooring.law));
  t.table(
      "mooring.force_table", {offset, force},
      "force towards the anchor over the offset, the same in every direction: from 0 where the mooring tightens on, "
      "linear between the rows; before the first row it is slack, beyond the last the last slope goes on",
      GEM_FIELD(mooring_design.force));
  t.table("mooring.direction_table", {direction_column, offset, force},
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

void add_dp(SceneTable& t) {
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

void add_transit(SceneTable& t) {
  t.number("transit.speed_m_per_s", "m/s", {0.0, 10.0},
           "speed at which the platform, a ship, is led along a path by a tow that holds it; 0: no transit. With a "
           "thrust: its speed at the start",
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

std::string section_of(const Option<SceneDef>& option) { return option.path.substr(0, option.path.find('.')); }

void add_breakup(SceneTable& t) {
  t.integer("breakup.maximum_pieces", {0.0, 1e6},
            "most pieces that floes which split in their plane give in a run, two for each split; 0: floes stay whole",
            GEM_FIELD(breakup.maximum_pieces));
  t.number("breakup.fracture_toughness_Pa_sqrt_m", "Pa m^0.5", {1e3, 1e7}, "fracture toughness of the ice",
           GEM_FIELD(breakup.fracture_toughness_Pa_sqrt_m));
  t.number("breakup.elastic_modulus_Pa", "Pa", {1e7, 1e11}, "elastic modulus of the ice, for the energy of cracks",
           GEM_FIELD(breakup.elastic_modulus_Pa));
  t.number("breakup.wedge_ratio", "", {0.01, 10.0},
           "force that opens the crack over the force of the contact: 1 / (2 tan t) for a wedge of half angle t",
           GEM_FIELD(breakup.wedge_ratio));
  t.number("breakup.load_time_s", "s", {1e-3, 60.0}, "a floe splits by the mean force of a contact over this time",
           GEM_FIELD(breakup.load_time_s));
  t.number("breakup.minimum_size_m", "m", floe_size_range, "size, the root of the area, of the smallest piece",
           GEM_FIELD(breakup.minimum_size_m));
}

/// Younger options stand at the end of their sections, so that cases without them keep their text.
void group_by_section(std::vector<Option<SceneDef>>& options) {
  std::vector<std::string> order;
  for (const auto& option : options)
    if (std::find(order.begin(), order.end(), section_of(option)) == order.end()) order.push_back(section_of(option));
  const auto place = [&](const Option<SceneDef>& o) { return std::find(order.begin(), order.end(), section_of(o)); };
  std::stable_sort(options.begin(), options.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
}

std::vector<Option<SceneDef>> make_scene_options() {
  SceneTable t;
  for (const auto section : {add_run, add_water, add_ice, add_floe_source, add_floe_sizes, add_boundary, add_platform,
                             add_mooring, add_contact, add_numerics, add_output})
    section(t);
  t.opt_in = true;
  for (const auto section : {add_drive, add_wind, add_mooring_laws, add_dp, add_breakup, add_transit}) section(t);
  group_by_section(t.options);
  return t.options;
}

std::vector<Option<IceClassDef>> make_ice_class_options() {
  OptionTable<IceClassDef> t;
  t.text("name", "name of the class", GEM_FIELD(name));
  t.number("thickness_m", "m", thickness_range, "thickness of its floes", GEM_FIELD(thickness_m));
  t.number("tenths", "", {0.0, 10.0},
           "weight of the class: its share of the ice area is tenths over the sum of all tenths; the concentration is "
           "set by "
           "floes.count",
           GEM_FIELD(tenths));
  return t.options;
}

std::vector<Option<ThrusterDef>> make_thruster_options() {
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

std::vector<Option<FloeDef>> make_floe_options() {
  OptionTable<FloeDef> t;
  t.outline("outline_m", {-1e3, 1e3}, "corners in body coordinates, any origin, either direction",
            GEM_FIELD(outline_m));
  t.pair("position_m", "m", place_range, "where the outline's origin stands", GEM_FIELD(position_m));
  t.number("angle_rad", "rad", {-6.3, 6.3}, "rotation about the outline's origin", GEM_FIELD(angle_rad),
           "one turn; 45 degrees are 0.785");
  t.pair("velocity_m_per_s", "m/s", speed_range, "velocity at the start", GEM_FIELD(velocity_m_per_s));
  t.number("spin_rad_per_s", "rad/s", spin_range, "spin at the start", GEM_FIELD(spin_rad_per_s));
  t.number("thickness_m", "m", thickness_range, "thickness", GEM_FIELD(thickness_m));
  return t.options;
}

std::vector<Option<FixedDef>> make_fixed_options() {
  OptionTable<FixedDef> t;
  t.outline("outline_m", place_range, "corners in world coordinates, either direction", GEM_FIELD(outline_m));
  return t.options;
}

}  // namespace

const std::vector<Option<SceneDef>>& scene_options() {
  static const auto options = make_scene_options();
  return options;
}

const std::vector<Option<IceClassDef>>& ice_class_options() {
  static const auto options = make_ice_class_options();
  return options;
}

const std::vector<Option<ThrusterDef>>& thruster_options() {
  static const auto options = make_thruster_options();
  return options;
}

const std::vector<Option<FloeDef>>& floe_options() {
  static const auto options = make_floe_options();
  return options;
}

const std::vector<Option<FixedDef>>& fixed_options() {
  static const auto options = make_fixed_options();
  return options;
}

std::string range_text(const Range& range, const std::string& unit) {
  std::string text = range.low_open || range.low == -infinity ? "(" : "[";
  text += plain_number_text(range.low) + ", " + plain_number_text(range.high);
  text += range.high_open || range.high == infinity ? ")" : "]";
  return unit.empty() ? text : text + " " + unit;
}

std::string columns_text(const std::vector<OptionColumn>& columns) {
  std::string text;
  for (const OptionColumn& column : columns) text += (text.empty() ? "[" : ", ") + column.name + " " + column.unit;
  return text + "]";
}

const std::vector<RenamedKey>& renamed_keys() {
  static const std::vector<RenamedKey> keys = {{"numerics", "moment_s", "time_step_s"},
                                               {"contact", "resolution", "solver"}};
  return keys;
}

std::string value_text(const OptionValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return toml_number_text(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* text = std::get_if<std::string>(&value)) return quoted_text(*text);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* pair = std::get_if<Vec2>(&value)) return pair_text(*pair);
  if (const auto* rows = std::get_if<OptionRows>(&value)) return rows_text(*rows);
  return outline_text(std::get<std::vector<Vec2>>(value));
}

std::string type_name(OptionType type) {
  switch (type) {
    case OptionType::number:
      return "number";
    case OptionType::integer:
      return "integer";
    case OptionType::text:
      return "text";
    case OptionType::choice:
      return "choice";
    case OptionType::flag:
      return "flag";
    case OptionType::pair:
      return "pair";
    case OptionType::outline:
      return "outline";
    case OptionType::table:
      return "table";
  }
  return "";
}

}  // namespace gem
