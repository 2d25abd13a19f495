// Which engine a run gets.
#include "gem/base/error.h"
#include "gem/command/command.h"

namespace gem {

std::vector<std::string> engine_choices() {
  std::vector<std::string> offered = engine_names();
  offered.insert(offered.begin(), {"auto", "cuda"});
  for (const std::string& name : baseline_names()) offered.push_back(name);
  return offered;
}

bool has_solver_on_gpu(const SceneDef& scene) { return scene.contact.solver != ContactSolver::compliant; }

std::unique_ptr<Engine> engine_for(const SceneDef& scene, const Bodies& field, const EngineOptions& options) {
  if (options.name != "auto") return make_engine(scene, field, options);
  EngineOptions chosen = options;
  try {
    chosen.name = "cuda";
    if (has_solver_on_gpu(scene)) return make_engine(scene, field, chosen);
  } catch (const Error& error) {
    if (error.code() != ExitCode::device && error.code() != ExitCode::resource_limit) throw;
  }
  chosen.name = "cpu";
  return make_engine(scene, field, chosen);
}

}  // namespace gem
