// The list of all rules of a scene.
#include "gem/scene/check_scene.h"

#include <utility>

#include "gem/base/error.h"
#include "gem/scene/checks/checks.h"

namespace gem {

std::vector<SceneProblem> check_scene(const SceneDef& scene) {
  SceneProblems problems;
  for (const auto rule : {check_name, check_time_step, check_output, check_floes, check_platform, check_listed_floes,
                          check_ice, check_drive, check_mooring, check_dp, check_breakup, check_transit})
    rule(scene, problems);
  return problems;
}

SceneDef with_listed_floes(const SceneDef& scene, std::vector<FloeDef> floes) {
  SceneDef listed = scene;
  listed.floes.source = FloeSource::listed;
  listed.floes.path.clear();
  listed.floes.time_s = 0.0;
  listed.floes.sha256.clear();
  listed.floes.concentration = 0.0;
  listed.floes.concave = ConcaveFloes::refuse;
  listed.floe = std::move(floes);
  for (const SceneProblem& problem : check_scene(listed))
    throw Error(ExitCode::scene_rejected, problem.key + ": " + problem.text);
  return listed;
}

std::vector<std::string> scene_warnings(const SceneDef& scene) {
  SceneWarnings warnings = scene.notes;
  for (const auto rule : {warn_of_ice, warn_of_floes, warn_of_time_step, warn_of_output, warn_of_platform,
                          warn_of_drive, warn_of_mooring, warn_of_dp, warn_of_transit})
    rule(scene, warnings);
  return warnings;
}

}  // namespace gem
