#include "bench/solver_study/scenes.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/scene/sweep/sweep.h"
#include "gem/scene/toml/scene_file.h"

namespace gem::bench {

SceneDef scene_named(const std::string& text) {
  const auto mark = text.find('#');
  if (mark == std::string::npos) return read_scene(text);
  const std::string path = text.substr(0, mark), name = text.substr(mark + 1);
  for (const SweepMember& member : expand_sweep(path))
    if (member.name == name) return member.scene;
  throw Error(ExitCode::usage, path + " has no run '" + name + "' (see gem sweep list) name one of them");
}

EngineState state_at(Engine& leader, double time_step_s, double time) {
  StepLog log;
  log.wants_events = false;
  const std::int64_t last = std::llround(time / time_step_s);
  while (leader.step() < last) {
    log.clear();
    leader.advance(std::min<std::int64_t>(100, last - leader.step()), log);
  }
  return leader.save();
}

}  // namespace gem::bench
