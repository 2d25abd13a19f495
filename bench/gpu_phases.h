// The phases that the speed on a GPU is measured in: drift and plug of the paper's main run, and the jam of its
// densest.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "gem/base/error.h"
#include "gem/engine/cuda/cuda_engine.h"
#include "gem/scene/sweep/sweep.h"

namespace gem {

struct Phase {
  const char* name;
  const char* run;
  double time;  // [s]
};
inline constexpr Phase phases[] = {
    {"drift", "004_400_25", 60.0}, {"plug", "004_400_25", 1800.0}, {"jam", "400_200_100", 600.0}};

/// A run of Table 1 by its name, with the iteration "gradient", which the recorded results have. Throws gem::Error if
/// there is none.
inline SceneDef scene_of(const std::string& cases, const std::string& run) {
  for (const SweepMember& member :
       expand_sweep(cases + "/table1.toml", {"contact.solver=\"coupled\"", "numerics.iteration=\"gradient\""}))
    if (member.name == run) return member.scene;
  throw Error(ExitCode::usage, "no run " + run + " in " + cases);
}

inline std::int64_t steps_in(const SceneDef& scene, double time) {
  return std::llround(time / scene.numerics.time_step_s);
}

/// The state at the start of a phase.
inline EngineState start_of(const Phase& phase, const SceneDef& scene, const Bodies& field) {
  CudaBatch batch({{scene, field}}, {.ring_steps = 4096, .samples = false});
  batch.advance(steps_in(scene, phase.time), nullptr);
  return batch.save(0);
}

}  // namespace gem
