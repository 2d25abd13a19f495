// Compares the reference engine with the cpu engine, time step by time step.
//
// Tolerances. An `independent` time step has one answer for each pair alone, so both engines round it differently and
// no more. A `coupled` time step is iterated by the cpu engine until no point asks for more than the residual r of
// numerics.residual_tolerance; the reference solves it to rounding. Visits with shared masses contract the error of a
// velocity by 1 - e at least, e being the smallest eigenvalue of the shared compliance: (pi / 2 n)^2 / p for n contacts
// in a row between a free and a held end, each body's mass shared by its p points. So the error is at most
// r p (2 n / pi)^2. `row` below is a bound on n, from the scene; p is counted in every time step. The factors before
// roundings and relative errors of events are chosen, with room for what is not derived.
#pragma once

#include <functional>
#include <string>

#include "gem/engine/engine.h"

namespace gem::agreement {

/// Time step of the scenes [s].
constexpr double dt = 0.05;

/// A scene, how long it is compared, and what the tolerance needs to know.
struct Comparison {
  SceneDef scene;
  int steps = 100;
  int row = 1;                 // most contacts in a row
  int contacts_of_a_body = 2;  // at most; checked where the engine keeps them, for `coupled`
  double slack = 0.0;          // what the cpu engine's way adds to the differences of velocities in a time step [m/s]
  bool anew = false;           // every time step starts from the cpu engine's state, so that differences do not grow
  int contacts = 1;            // at least so many points over all time steps
  bool thrown = false;         // every floe with a velocity of its own
  const EngineState* start = nullptr;                    // otherwise the scene's
  Vec2 push = {};                                        // of the last floe, into its neighbour before the start [m]
  std::function<bool(const StepLog&)> begins = nullptr;  // comparing, after a time step of the cpu engine
  std::function<void(const StepLog&)> also = nullptr;    // what else each time step of the reference has to show
};

/// Nothing but what a test switches on: no current, drag, friction, elastic stress, cap, boundary or platform.
SceneDef still_scene();

/// A rectangle of ice, 0.5 m thick.
FloeDef floe(double length, double width, Vec2 position, Vec2 velocity = {}, double angle = 0.0, double spin = 0.0);

/// Expects both engines to agree on bodies, platform, books, events and overlaps.
void compare(const Comparison& c);

}  // namespace gem::agreement
