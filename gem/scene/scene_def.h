// The options of a scene with their defaults and units. Constant during a run.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/events/events.h"
#include "gem/events/platform/dp_design.h"
#include "gem/events/platform/mooring_tables.h"

namespace gem {

enum class Yaw { free, locked };
enum class PlatformOutline { regular, ship, listed, pieces };
enum class Placement { random, tiled };
enum class FloeSource { generated, copied, file, listed };
enum class ConcaveFloes { refuse, cut, hull };
enum class SizeLaw { lognormal, gamma };

struct RunDef {
  std::string name = "run";
  double duration_s = 7200.0;
  std::uint64_t seed = 1;
};

/// One class of ice: its thickness and its tenths, as the paper states it. Only the ratio of the tenths is used.
struct IceClassDef {
  std::string name = "thin";
  double thickness_m = 0.5;
  double tenths = 4.0;
};

/// Where the floes come from, and how a field is generated.
struct FloesDef {
  FloeSource source = FloeSource::generated;
  std::string path;     ///< for `file`: .csv, .geojson or a run file; relative to the case file
  double time_s = 0.0;  ///< of the frame, where `path` is a run file; 0: its start
  std::string sha256;   ///< for `file`: of the floes that it must hold, see floes_sha256(); empty: not checked
  ConcaveFloes concave = ConcaveFloes::refuse;  ///< for .csv and .geojson: outlines that are not convex
  std::int64_t count = 4008;
  double concentration = 0.0;  ///< share of the field's free water that floes cover, replaces `count`; 0: not used
  double length_m = 1500.0;    ///< along the current
  double width_m = 400.0;
  double start_x_m = -1575.0;  ///< upstream end of the field; it ends at start_x_m + length_m
  SizeLaw size_law = SizeLaw::lognormal;
  double size_minimum_m = 2.0;  ///< size = sqrt(area)
  double size_maximum_m = 20.0;
  double size_mean_m = 6.9;
  double size_deviation_m = 3.9;
  double gap_m = 0.05;                      ///< smallest distance between floes at the start
  Placement placement = Placement::random;  ///< for `copied`
  std::int64_t shape_count = 24;            ///< for `copied`: number of different shapes
  double tile_length_m = 100.0;             ///< for `tiled`: approximate length of the repeated block
  std::int64_t moved_floe = -1;  ///< floe that is shifted by moved_by_m, counted from the anchor from 0; -1: none
  Vec2 moved_by_m = {0.0, 0.0};  ///< small shift of the start position
  std::vector<IceClassDef> classes = {IceClassDef{}};
  double overlap = 0.0;  ///< no option: how deep floes of a recorded frame may overlap at the start [m]
};

/// Two fixed bodies beside the channel, inlet_width apart upstream, straight to gap at x = 0, parallel after it.
struct BoundaryDef {
  bool present = true;
  double inlet_x_m = -1600.0;
  double inlet_width_m = 400.0;
  double taper_start_x_m = -1600.0;  ///< straight up to here; at or upstream of the inlet the whole channel tapers
  double gap_m = 400.0;
  double outlet_x_m = 60.0;
};

/// A convex piece of a platform, in the axes of the platform (any origin, either direction).
struct PlatformPieceDef {
  std::vector<Vec2> outline_m;
};

struct PlatformDef {
  bool present = true;
  PlatformOutline outline = PlatformOutline::regular;
  int sides = 20;
  double diameter_m = 100.0;  ///< of the circle through the corners
  double length_m = 200.0;    ///< of a ship, over all
  double beam_m = 40.0;
  double bow_length_m = 50.0;           ///< from the stem to where the sides are parallel; 0: a flat bow
  double stern_length_m = 30.0;         ///< from the end of the parallel sides to the transom; 0: all of it parallel
  std::vector<Vec2> outline_m;          ///< for `listed`: convex, any origin, either direction
  std::vector<PlatformPieceDef> piece;  ///< for `pieces`: they move together
  double mass_kg = 1e8;
  Vec2 anchor_m = {0.0, 0.0};
  Vec2 start_offset_m = {0.0, 0.0};
  Vec2 start_velocity_m_per_s = {0.0, 0.0};
  double start_yaw_rad = 0.0;
  double start_spin_rad_per_s = 0.0;
  Yaw yaw = Yaw::free;
  double inertia_kg_m2 = 0.0;  ///< about the centroid; 0: of the mass spread over the outline
  bool fixed = false;          ///< it does not move: the loads are the forces on it
};

/// How the impulses of a coupled time step are found.
enum class Iteration {
  gradient,  ///< projected gradient: cheap iterations, many to converge
  splitting  ///< operator splitting with a factored matrix, each island by itself
};

/// When the iterations of a coupled time step end.
struct IterationEnd {
  double residual_tolerance;  ///< over the current speed
  std::int64_t iterations_maximum;
};

/// The defaults of a case that gives neither. Splitting meets its tolerance; gradient, in a crowd, only its maximum.
constexpr IterationEnd default_end(Iteration iteration) {
  return iteration == Iteration::splitting ? IterationEnd{3e-3, 384} : IterationEnd{1e-5, 32};
}

struct NumericsDef {
  double time_step_s = 0.05;  ///< dt
  Iteration iteration = Iteration::splitting;
  /// coupled: residual at which the iterations end, over the current speed
  double residual_tolerance = default_end(Iteration::splitting).residual_tolerance;
  std::int64_t iterations_maximum = default_end(Iteration::splitting).iterations_maximum;
  double contact_reach =
      1.5;  ///< coupled: faces that the current could close within this many time steps count as contacts
  double repair_share = 0.6;          ///< coupled: share of an overlap removed in one time step
  double repair_speed_m_per_s = 0.1;  ///< coupled: largest speed at which an overlap is removed
  std::int64_t substeps = 0;          ///< compliant: of a time step; 0: by the rule of substep_count.h
  double list_margin_m = 2.5;         ///< pairs closer than this are in the pair list
};

struct OutputDef {
  double platform_interval_s = 0.1;  ///< if a case does not give it: the next whole number of time steps
  double floes_interval_s = 10.0;
  double force_window_s = 1.0;  ///< averaging window of the reported ice force
  bool platform_events = true;
  bool contact_forces = false;  ///< with every floe frame: the forces between bodies
  bool side_loads = false;      ///< with every platform sample: the impulse on each side of the outline
  bool line_tensions = false;   ///< with every platform sample: the largest tension of each mooring line since the last
  double event_speed_m_per_s =
      0.01;                    ///< slower contacts count as static load: in the force channels, not in the event list
  double hit_release_s = 3.0;  ///< a floe that has not pressed on the platform for this long hits anew
  double retire_x_m = 300.0;   ///< a floe whose centre passes this line is retired
};

/// A floe or fixed body given by its outline (body coordinates, any origin, either direction).
struct FloeDef {
  std::vector<Vec2> outline_m;
  Vec2 position_m;  ///< where the outline's origin stands
  double angle_rad = 0.0;
  Vec2 velocity_m_per_s;
  double spin_rad_per_s = 0.0;
  double thickness_m = 0.5;
};

struct FixedDef {
  std::vector<Vec2> outline_m;  ///< world coordinates
};

/// The definitions of the events (current, water, ice, mooring, platform_drag, contact, wind, coriolis, breakup) stand
/// with the laws in events.h.
struct SceneDef : EventDefinitions {
  RunDef run;
  FloesDef floes;
  BoundaryDef boundary;
  PlatformDef platform;
  NumericsDef numerics;
  OutputDef output;
  DriveDef drive;                  ///< tables of current, tide and wind
  MooringDesign mooring_design;    ///< tables and lines of the mooring
  DpDef dp;                        ///< dynamic positioning
  TransitDef transit;              ///< the platform as a ship on its way
  std::vector<FloeDef> floe;       ///< for source = listed
  std::vector<FixedDef> fixed;     ///< obstacles besides the boundary
  std::vector<std::string> notes;  ///< old key names that the file uses; not part of the scene
};

}  // namespace gem
