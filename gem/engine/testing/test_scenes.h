// Scenes for the tests of the engines: small, with all laws on, and with contacts from the first seconds.
#pragma once

#include <memory>
#include <string>

#include "gem/base/random.h"
#include "gem/base/strict_math.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem/scene/scene_mooring.h"

namespace gem::test {

/// The scene with an iteration and the end that is its default.
inline SceneDef iterated_by(SceneDef scene, Iteration iteration) {
  const IterationEnd end = default_end(iteration);
  scene.numerics.iteration = iteration;
  scene.numerics.residual_tolerance = end.residual_tolerance;
  scene.numerics.iterations_maximum = end.iterations_maximum;
  return scene;
}

/// Sets the iteration "gradient" with its defaults. Every route of a device has it; tests of splitting ask for it.
inline void use_gradient(SceneDef& scene) { scene = iterated_by(std::move(scene), Iteration::gradient); }

/// A free platform with damping and drag in a narrowing channel; 150 floes of three thicknesses; friction; a retire
/// line.
inline SceneDef busy_scene(std::uint64_t seed) {
  SceneDef scene;
  scene.contact.solver = ContactSolver::coupled;
  use_gradient(scene);
  scene.run.seed = seed;
  scene.current.velocity_m_per_s = {0.8, 0.1};
  scene.floes.count = 150;
  scene.floes.length_m = 150.0;
  scene.floes.width_m = 80.0;
  scene.floes.start_x_m = -175.0;
  scene.floes.size_maximum_m = 12.0;
  scene.floes.size_mean_m = 6.0;
  scene.floes.size_deviation_m = 2.0;
  scene.floes.classes = {{"thick", 1.2, 1.0}, {"medium", 0.7, 2.0}, {"thin", 0.5, 1.0}};
  scene.boundary.inlet_x_m = scene.boundary.taper_start_x_m = -190.0;
  scene.boundary.inlet_width_m = 90.0;
  scene.boundary.gap_m = 50.0;
  scene.boundary.outlet_x_m = 60.0;
  scene.platform.diameter_m = 20.0;
  scene.platform.mass_kg = 4e6;
  scene.platform.start_offset_m = {0.3, -0.2};
  scene.platform.start_velocity_m_per_s = {0.0, 0.1};
  scene.mooring.stiffness_N_per_m = 2e5;
  scene.mooring.damping_ratio = 0.02;
  scene.platform_drag.present = true;
  scene.platform_drag.water = DampingWater::current;
  scene.output.retire_x_m = 20.0;
  return scene;
}

/// The busy scene with everything that drives it: a current that turns, tide, wind that changes, turned drag, Coriolis
/// force, wind on the platform. All of it changes within a few seconds.
inline SceneDef driven_scene(std::uint64_t seed) {
  SceneDef scene = busy_scene(seed);
  scene.drive.current_direction = {{0.0, 0.8, -0.3}, {4.0, 0.7, 0.6}, {20.0, 0.9, 1.2}};
  scene.drive.tide = {{60.0, 0.1, 0.4, 0.2, 1.0}};
  scene.drive.wind_velocity = {{1.0, 15.0, 5.0}, {6.0, -5.0, 12.0}};
  scene.drive.start_time_s = 0.5;
  scene.wind.form_coefficient = 0.5;
  scene.wind.platform_area_m2 = 300.0;
  scene.water.turning_rad = 0.4;
  scene.coriolis.parameter_per_s = 1.4e-4;
  return scene;
}

/// The busy scene around a platform of three pieces, whose notch is open to the ice.
inline SceneDef pieces_scene(std::uint64_t seed) {
  SceneDef scene = busy_scene(seed);
  scene.platform.outline = PlatformOutline::pieces;
  scene.platform.piece = {{{{0.0, -12.0}, {6.0, -12.0}, {6.0, 12.0}, {0.0, 12.0}}},
                          {{{-12.0, 6.0}, {0.0, 6.0}, {0.0, 12.0}, {-10.0, 12.0}}},
                          {{{-12.0, -6.0}, {-10.0, -12.0}, {0.0, -12.0}, {0.0, -6.0}}}};
  scene.platform.start_yaw_rad = 0.2;
  scene.platform.anchor_m = {-8.0, 0.0};  // close behind the ice
  return scene;
}

/// A column of floes that a current presses into a notch of three pieces, the first of them with a millimetre of room
/// on each side.
inline SceneDef column_between_pieces() {
  SceneDef scene = pieces_scene(1);
  scene.contact.solver = ContactSolver::coupled;
  scene.platform.piece = {{{{2.5, -20.0}, {12.5, -20.0}, {12.5, 20.0}, {2.5, 20.0}}},
                          {{{-17.5, 10.0}, {2.5, 10.0}, {2.5, 20.0}, {-17.5, 20.0}}},
                          {{{-17.5, -20.0}, {2.5, -20.0}, {2.5, -10.0}, {-17.5, -10.0}}}};
  scene.platform.start_yaw_rad = 0.0;
  scene.platform.start_offset_m = scene.platform.start_velocity_m_per_s = scene.platform.anchor_m = {};
  scene.boundary.present = false;
  scene.current.velocity_m_per_s = {0.5, 0.0};
  scene.floes.source = FloeSource::listed;
  scene.floes.count = 0;
  scene.output.retire_x_m = 1000.0;
  for (int k = 0; k < 4; ++k) {
    const double half = k == 0 ? 9.999 : 6.0;
    FloeDef floe;
    floe.outline_m = {{-5.0, -half}, {5.0, -half}, {5.0, half}, {-5.0, half}};
    floe.position_m = {-2.6 - 10.1 * k, 0.0};
    scene.floe.push_back(floe);
  }
  return scene;
}

/// Whether a floe presses on two pieces of column_between_pieces(), whose bodies are the first three.
inline bool has_floe_on_two_pieces(const std::vector<ContactForce>& forces) {
  for (const ContactForce& one : forces)
    for (const ContactForce& other : forces)
      if (one.b == other.b && one.a < other.a && other.a < 3) return true;
  return false;
}

/// The busy scene around a ship whose bow is turned out of the ice and steered back; `fixed`: it does not move.
inline SceneDef ship_scene(std::uint64_t seed, bool fixed) {
  SceneDef scene = busy_scene(seed);
  scene.current.velocity_m_per_s = {1.6, 0.1};
  scene.platform.outline = PlatformOutline::ship;
  scene.platform.length_m = 30.0;
  scene.platform.beam_m = 9.0;
  scene.platform.bow_length_m = 8.0;
  scene.platform.stern_length_m = 5.0;
  scene.platform.start_yaw_rad = 0.3;
  scene.platform.anchor_m = {-11.0, 0.0};  // close behind the ice: it is there within 6 s
  scene.platform.inertia_kg_m2 = 4e8;
  scene.heading = {2e7, 1e8};
  scene.platform.fixed = fixed;
  scene.platform.start_velocity_m_per_s = {fixed ? 0.0 : -0.5, 0.0};
  return scene;
}

/// The ship that moves, with water drag by axis.
inline SceneDef dragged_ship_scene(std::uint64_t seed) {
  SceneDef scene = ship_scene(seed, false);
  scene.platform_drag.law = PlatformDragLaw::by_axis;
  return scene;
}

/// The ship that moves, with water that moves along.
inline SceneDef ship_scene_with_added_mass(std::uint64_t seed) {
  SceneDef scene = dragged_ship_scene(seed);
  scene.added_mass = {1e5, 3e6, 2e8, -4e6};
  return scene;
}

/// The busy scene with its platform close behind the ice, which is there within a second.
inline SceneDef scene_close_to_ice(std::uint64_t seed) {
  SceneDef scene = busy_scene(seed);
  scene.platform.anchor_m = {-18.0, 0.0};
  return scene;
}

/// The busy scene on a mooring of tables by direction, with stiffness and damping of the yaw.
inline SceneDef moored_scene(std::uint64_t seed) {
  SceneDef scene = scene_close_to_ice(seed);
  scene.mooring = {.damping_ratio = 0.0,
                   .law = MooringLaw::table,
                   .damping_N_s_per_m = 3e4,
                   .yaw_stiffness_N_m_per_rad = 5e7,
                   .yaw_damping_N_m_s_per_rad = 1e6};
  for (const auto& [angle, stiffness] : {std::pair{-1.0, 1e5}, {0.3, 4e5}, {1.7, 2e5}, {3.0, 3e5}, {4.2, 2.5e5}})
    for (const auto& [offset, share] : {std::pair{0.05, 0.0}, {0.2, 0.15}, {2.0, 4.0}})
      scene.mooring_design.direction.push_back({angle, offset, share * stiffness});
  return scene;
}

/// The busy scene on six taut lines that are hardly stronger than at the start: some of them break within seconds.
inline SceneDef lines_scene(std::uint64_t seed) {
  SceneDef scene = scene_close_to_ice(seed);
  scene.mooring = {.damping_ratio = 0.0, .law = MooringLaw::catenary, .damping_N_s_per_m = 3e4};
  scene.mooring_design.line_height_m = 30.0;
  for (int k = 0; k < 6; ++k) {
    const Rotation q = strict::rotation_of_turns(k / 6.0 + 0.05);
    const Vec2 e{q.cosine, q.sine};
    const Vec2 at = scene.platform.anchor_m + 310.0 * e;
    scene.mooring_design.lines.push_back({at.x, at.y, 10.0 * e.x, 10.0 * e.y, 303.0, 800.0, 2e8, 0.0});
  }
  const std::vector<double> tensions = line_tensions_at_start(scene);
  for (std::size_t k = 0; k < tensions.size(); ++k) scene.mooring_design.lines[k][7] = 1.001 * tensions[k];
  return scene;
}

/// The busy scene with thrusters of every kind that are too weak at times, beside the mooring.
inline SceneDef dp_scene(std::uint64_t seed) {
  SceneDef scene = scene_close_to_ice(seed);
  DpDef& dp = scene.dp;
  dp.position_m = {-17.5, -0.3};
  dp.follows_drift = true;
  dp.surge_period_s = dp.sway_period_s = 40.0;
  dp.yaw_period_s = 30.0;
  dp.integral_time_s = 60.0;
  dp.filter_time_s = 0.5;
  dp.thruster = {{.kind = ThrusterKind::azimuth, .position_m = {8.0, 1.0}, .maximum_N = 2e5, .rate_N_per_s = 4e5},
                 {.kind = ThrusterKind::azimuth, .position_m = {8.0, -1.0}, .maximum_N = 2e4},
                 {.kind = ThrusterKind::tunnel, .position_m = {-9.0, 0.0}, .maximum_N = 1e5},
                 {.kind = ThrusterKind::fixed,
                  .position_m = {-7.0, 2.0},
                  .direction_rad = 0.4,
                  .maximum_N = 1e5,
                  .reverse_share = 0.6}};
  return scene;
}

/// The busy scene of soft ice: thirty floes split within 120 time steps.
inline SceneDef breaking_scene(std::uint64_t seed) {
  SceneDef scene = busy_scene(seed);
  scene.breakup.maximum_pieces = 100;
  scene.breakup.minimum_size_m = 1.0;
  scene.breakup.load_time_s = 0.4;
  scene.breakup.fracture_toughness_Pa_sqrt_m = 5e4;
  return scene;
}

/// The busy scene around a platform that goes upstream into the ice and turns at a way point within two seconds.
inline SceneDef transit_scene(std::uint64_t seed) {
  SceneDef scene = scene_close_to_ice(seed);
  scene.platform.start_velocity_m_per_s = {};
  scene.mooring.stiffness_N_per_m = scene.mooring.damping_ratio = 0.0;
  scene.transit = {.speed_m_per_s = 1.0, .way_point_m = {{-22.0, 0.0}, {-58.0, 12.0}}, .turn_radius_m = 20.0};
  return scene;
}

/// The same with a ship that runs free: it starts at 1 m/s, and the ice slows it down.
inline SceneDef free_ship_scene(std::uint64_t seed) {
  SceneDef scene = transit_scene(seed);
  scene.transit = {.speed_m_per_s = 1.0,
                   .course_rad = 3.0,
                   .bollard_thrust_N = 0.02 * scene.platform.mass_kg,
                   .open_water_speed_m_per_s = 2.0};
  return scene;
}

/// The field of a scene, with random velocities and spins of the floes.
inline Bodies busy_field(const SceneDef& scene) {
  Bodies bodies = make_field(scene);
  RandomSequence random(Random(scene.run.seed, 77));
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.kind[i] != BodyKind::floe) continue;
    bodies.velocity[i] = {random.uniform(-0.5, 1.5), random.uniform(-1.0, 1.0)};
    bodies.spin[i] = random.uniform(-0.1, 0.1);
  }
  return bodies;
}

inline std::unique_ptr<Engine> busy_engine(const SceneDef& scene, const std::string& name, int threads = 1) {
  return make_engine(scene, busy_field(scene), {name, threads});
}

/// Number of contact points over all time steps of a log.
inline std::int64_t contacts_in(const StepLog& log) {
  std::int64_t sum = 0;
  for (const StepQuality& quality : log.quality) sum += quality.contacts;
  return sum;
}

/// Sum of the magnitudes of the ice's impulses on the platform over all time steps of a log [N s].
inline double ice_impulse_in(const StepLog& log) {
  double sum = 0.0;
  for (const PlatformStep& step : log.platform) sum += length(step.ice_impulse);
  return sum;
}

}  // namespace gem::test
