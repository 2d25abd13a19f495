// Runs a case through the library and prints the largest ice load on the platform. Usage: largest_load CASE.toml
// [SECONDS]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "gem/base/error.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem/scene/toml/scene_file.h"

namespace {

/// The largest ice force averaged over one time step, and when that step ended.
struct Largest {
  double force = 0.0;  // [N]
  double time = 0.0;   // [s]
};

Largest run(gem::Engine& engine, double duration_s, double time_step_s) {
  const auto steps = static_cast<std::int64_t>(std::llround(duration_s / time_step_s));
  Largest largest;
  gem::StepLog log;
  log.wants_events = false;
  while (engine.step() < steps) {
    const std::int64_t first = engine.step();
    log.clear();
    engine.advance(std::min<std::int64_t>(1000, steps - first), log);
    for (std::size_t i = 0; i < log.platform.size(); ++i) {
      const double force = gem::length(log.platform[i].ice_impulse) / time_step_s;
      if (force > largest.force) largest = {force, static_cast<double>(first + std::int64_t(i) + 1) * time_step_s};
    }
  }
  return largest;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: largest_load CASE.toml [SECONDS]\n");
    return 2;
  }
  const gem::SceneDef scene = gem::read_scene(argv[1]);
  const double duration_s = argc > 2 ? std::atof(argv[2]) : scene.run.duration_s;
  const auto engine = gem::make_engine(scene, gem::make_field(scene), {});
  const Largest largest = run(*engine, duration_s, scene.numerics.time_step_s);
  std::printf("largest ice force %.6g N in the time step to %.6g s, state hash %016llx\n", largest.force, largest.time,
              static_cast<unsigned long long>(engine->state_hash()));
  return 0;
} catch (const gem::Error& error) {
  std::fprintf(stderr, "largest_load: %s\n", error.what());
  return static_cast<int>(error.code());
}
