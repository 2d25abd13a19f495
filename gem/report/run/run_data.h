// The data of one run for a report, in plain arrays: read from a run file, or made by a test.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/engine/step/overlap_count.h"
#include "gem/record/verdict.h"
#include "gem/report/run/dp_record.h"
#include "gem/report/run/fixed_record.h"
#include "gem/report/run/line_record.h"
#include "gem/report/run/side_record.h"
#include "gem/report/run/transit_record.h"

namespace gem {

/// Origin of a run. Texts are empty and numbers 0 if the file does not say.
struct RunIdentity {
  std::string name;
  std::string status;  // running | complete | stopped:<reason>
  std::string case_hash;
  std::string state_hash;
  std::string seed;
  std::string source;   // program, version and commit
  std::string build;    // program, version and commit with build type and compiler
  std::string history;  // time and command of the run
  std::string engine;
  std::string solver;
  std::string threads;
  double time_step_s = 0.0;
};

/// Forces act on the platform [N]; `ice_force` is the mean over one sample, `ice_force_mean` over force_window_s.
struct PlatformRecord {
  std::vector<double> time, x, y;
  std::vector<double> ice_force_x, ice_force_y;
  std::vector<double> ice_force_mean_x, ice_force_mean_y;
  std::vector<double> mooring_force_x, mooring_force_y;
  std::vector<double> contacts;
  std::vector<double> yaw = {};                              // [rad]
  std::vector<double> drag_force_x = {}, drag_force_y = {};  // of water and wind; empty where neither acts
};

/// Events on the platform; the normal points from the platform into the ice.
struct EventColumns {
  std::vector<double> time;
  std::vector<std::int32_t> body_b;
  std::vector<double> nx, ny;
  std::vector<double> impulse;     // normal [N s]
  std::vector<double> force_peak;  // largest force, or closed-form crushing peak [N]
  bool resolved = false;           // force_peak is the largest force of substeps
};

struct StatsRecord {
  std::vector<double> time;
  std::vector<double> residual_momentum, residual_angular_momentum, residual_energy;  // relative
  std::vector<double> maximum_overlap;                                                // [m]
  std::vector<double> wall_time, sim_rate;
  std::vector<double> maximum_overlap_share = {};  // of the size of the smaller body
  std::vector<double> complementarity = {};        // [m/s]
  std::vector<double> cone_excess = {};            // [N s]
  std::vector<double> energy_created = {};         // [J]
  OverlapCount overlap = {}, overlap_share = {};   // of the whole run [m], [-]
};

struct FloeFrame {
  double time = 0.0;
  std::vector<double> x, y, theta, speed;  // one entry per floe; not finite for a floe that is gone
};

using Corners = std::vector<Vec2>;

struct RunData {
  RunIdentity identity;
  RunVerdict verdict;             // without judgements: not judged
  double duration_s = 0.0;        // simulated
  double natural_period_s = 0.0;  // along x: 2 pi sqrt(M / k); 0 without mooring
  double natural_period_y_s = 0.0;
  double current_speed = 0.0;   // [m/s]
  double force_window_s = 0.0;  // of ice_force_mean
  Vec2 rest;                    // rest position of the mooring [m]
  bool is_held = true;          // a mooring, thrusters or a tow can pull the platform
  std::string dragged_by = {};  // "water drag", "wind" or "water drag and wind" on the platform; empty: neither
  PlatformRecord platform;
  EventColumns events;
  StatsRecord stats;
  Corners platform_outline;              // about its centre; of several pieces: the corners of all
  std::vector<Corners> platform_pieces;  // their outlines, if there are several
  std::vector<Corners> fixed;            // world
  std::vector<Corners> floe_outlines;    // about the centroid
  std::optional<double> at_s = {};       // the time that the report shows; empty: the middle of the run
  std::vector<SideRecord> sides = {};    // of the platform; empty if not recorded
  std::vector<LineRecord> lines = {};    // of the mooring
  DpRecord dp = {};                      // empty without thrusters
  TransitRecord transit = {};            // empty without transit
  FixedRecord on_fixed = {};             // empty without [[fixed]] or without the forces between bodies
  std::vector<FloeFrame> frames;         // start, at_s, end; fewer if the run recorded fewer than three
};

}  // namespace gem
