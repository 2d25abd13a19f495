// A field that moves time step by time step with any way of resolving its contacts, and what that way is judged by.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/solver_study/method.h"
#include "gem/engine/cpu/pair_list.h"
#include "gem/engine/engine.h"
#include "gem/engine/step/overlap_count.h"

namespace gem::bench {

/// Sums over the time steps of a run.
struct MovingScore {
  std::int64_t steps = 0, points = 0;
  double deepest = 0.0;       // [m]
  double depth_sum = 0.0;     // over all points, apart ones with 0 [m]
  OverlapCount depth;         // of all points
  Vec2 platform_impulse;      // from the ice [N s]
  Vec2 fixed_impulse;         // given by fixed bodies [N s]
  double created = 0.0;       // kinetic energy that resolving added, in the time steps in which it added [J]
  double lost = 0.0;          // ... took, in the others [J]
  double fastest_back = 0.0;  // platform's largest speed against its start velocity [m/s]
};

class MovingField {
 public:
  MovingField(const SceneDef& scene, const EngineState& state);

  /// Contacts of the time step, judged.
  Contacts find();
  /// Drag on the floes and the first half of the platform's motion, with the constants in force.
  void kick();
  /// Notes what impulses changed since the velocities given; changes up to the next kick count as one.
  void note_change(const std::vector<Vec2>& velocity, const std::vector<double>& spin);
  void drift();
  /// The velocities and shifts of a resolved problem.
  void take(const Problem& problem, const Motions& motions);

  FieldState f;
  WarmStart last;  // impulses of the last time step
  MovingScore score;
  ThreadTeam team{1};

 private:
  PairList pairs_;
  double energy_change_ = 0.0;  // since the last kick [J]
  Vec2 start_velocity_;         // of the platform
};

/// One way to move a field by a time step.
struct Stepper {
  std::string name;
  std::function<void(MovingField&)> step;
};

/// What a stepper of passes takes over from the last time step.
struct WarmOptions {
  bool impulses = true;
  double repair = repair_memory;
};

/// gem's own solver, as the engine calls it.
Stepper production(std::int64_t iterations);
/// `passes` of a candidate in every time step.
Stepper passes_of(const std::string& name, const Candidate& candidate, int passes, const WarmOptions& warm = {});
/// Small steps: the contacts of a time step are followed through `steps` short time steps of one Gauss-Seidel pass
/// each.
Stepper small_steps(const SceneDef& scene, int steps);
/// Soft steps with relaxation as in Box2D v3: each short time step presses with soft contacts, moves, and takes the
/// velocity of the softness back; two passes each.
Stepper soft_steps(const SceneDef& scene, int steps);

}  // namespace gem::bench
