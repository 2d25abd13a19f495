// One time step's contact problem taken out of an engine, and the measure by which all solvers are judged.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "bench/solver_study/studied_point.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem::bench {

struct ProblemPoint {
  std::int32_t a = 0, b = 0;
  StudiedPoint own;     // compliance with the bodies' whole masses
  StudiedPoint shared;  // ... with each mass shared out among the body's points
};

using Impulses = std::vector<PointImpulse<double>>;
using Motions = std::vector<Motion<double>>;

/// Points of a pair are neighbours, pairs ascending. Bodies as in the field.
struct Problem {
  double dt = 0.0;  // [s]
  std::vector<ProblemPoint> point;
  std::vector<double> mass, inertia, inverse_mass, inverse_inertia;
  std::vector<Vec2> velocity;  // before the events [m/s]
  std::vector<double> spin;    // [rad/s]

  std::size_t points() const { return point.size(); }
  std::size_t bodies() const { return mass.size(); }
};

/// Of contacts that prepare_contact() has seen; `start` gives the last impulses for the crushing limit's bound.
Problem make_problem(const FieldState& f, Contacts contacts, const Impulses& start);

/// What a time step starts from, by the contact points' names.
using WarmStart = std::map<std::uint64_t, PointImpulse<double>>;
/// `repair_share`: how much of the last repair is taken over.
Impulses warm_impulses(Contacts contacts, const WarmStart& last, double repair_share);
WarmStart remembered(Contacts contacts, const Impulses& impulses);

/// Velocities and repair shifts that the impulses give.
Motions motions_of(const Problem& problem, const Impulses& impulses);

/// Adds what a change of one point's impulse gives to its two bodies.
void add_change(const Problem& problem, const ProblemPoint& point, const PointImpulse<double>& change,
                Motions& motions);

/// Scales the impulses to the share that leaves the least energy, if that is below `limit`.
void keep_best_share(const Problem& problem, Impulses& impulses, double limit);

/// Natural map: how far each point, with all others as they are, is from its law.
struct Score {
  double largest = 0.0;         // speed that a point still asks for [m/s]
  double rms = 0.0;             // over the points [m/s]
  double largest_repair = 0.0;  // shift that a point still asks for [m]
};
Score score_of(const Problem& problem, const Impulses& impulses);

}  // namespace gem::bench
