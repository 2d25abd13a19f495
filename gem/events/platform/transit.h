// Transit: the platform is a ship that is led along a path at a given speed, as a tow at constant speed does. A ship
// with a thrust runs free along a straight path: then the tow holds it only across the path and in yaw.
//
//   v := v_p + (x_p - x) / T       r := r_p + sin(theta_p - theta) / T       at the start of a time step
//
//   x, theta, v, r    place, yaw, velocity and yaw rate of the ship [m], [rad], [m/s], [rad/s]
//   x_p, theta_p      place and yaw on the path at the start of the time step
//   v_p, r_p          mean velocity and yaw rate of the path over the time step
//   T                 time in which the ship makes up what the ice held it back, 1 s, or five longer time steps [s]
//
// The path is made of straight legs between way points and arcs of one radius that touch them; after the last way point
// it goes straight on. The yaw turns with the course, so the drift angle of the start stays.
//
// The tow acts between time steps. In a hit the ship counts with its own mass and moment of inertia: a hit of a floe of
// mass m takes m v / (1 + m / M) of its momentum, and the tow gives it back before the next time step. Under a steady
// load F the ship lags behind its path by F dt T / 2 M. The force of the tow is what the ice, the water and the wind
// take, and what turns the ship; it stands in the books where the force of a mooring does.
//
// Sources: captive tests in ice tanks (ITTC 7.5-02-04-02.1, resistance test in ice: towed model at constant speed; the
// mean force along the course is the resistance). The law is a proportional control of the place over a reset of the
// velocity.
// Range: dt well below T; F dt well below M v. Neglected: squat, the change of the water resistance by the ice. Thrust:
// transit_thrust.h.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// The section [transit].
struct TransitDef {
  double speed_m_per_s = 0.0;                           ///< along the path; of a ship with thrust at the start
  double course_rad = 3.141592653589793;                ///< of a path without way points
  std::vector<std::array<double, 2>> way_point_m = {};  ///< from the start on; none: straight along the course
  double turn_radius_m = 200.0;                         ///< of the arcs at way points
  double bollard_thrust_N = 0.0;                        ///< net thrust at rest; 0: the ship is towed
  double open_water_speed_m_per_s = 0.0;                ///< at which no thrust is left
};

/// Whether there is a ship in transit that runs free, by its own thrust.
inline bool runs_free(const TransitDef& def) { return def.bollard_thrust_N > 0.0; }

/// Whether there is a ship in transit.
inline bool in_transit(const TransitDef& def) { return def.speed_m_per_s > 0.0 || runs_free(def); }

/// Where the path leads in one time step.
struct TowStep {
  Vec2 place;         // at its start [m]
  Rotation rotation;  // at its start
  Vec2 velocity;      // mean [m/s]
  double spin = 0.0;  // mean [rad/s]
};

/// 1 / T for time steps of `dt` [1/s].
inline double tow_rate(double dt) { return 1.0 / std::max(1.0, 5.0 * dt); }

/// Velocity that the tow gives to a ship at `place` [m/s].
GEM_HD inline Vec2 tow_velocity(const TowStep& step, Vec2 place, double rate) {
  return step.velocity + rate * (step.place - place);
}

/// Velocity that the tow gives to a ship that runs free along `course` with the velocity `v`: it holds it across only.
GEM_HD inline Vec2 tow_across(const TowStep& step, Vec2 place, double rate, Vec2 course, Vec2 v) {
  return dot(course, v) * course + rate * cross(course, step.place - place) * Vec2{-course.y, course.x};
}

/// Yaw rate that the tow gives to a ship turned by `q` [rad/s].
GEM_HD inline double tow_spin(const TowStep& step, Rotation q, double rate) {
  return step.spin + rate * (q.cosine * step.rotation.sine - q.sine * step.rotation.cosine);
}

}  // namespace gem
