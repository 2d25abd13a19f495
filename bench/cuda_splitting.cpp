// Speed of operator splitting on a GPU beside the other iteration, as CSV: the regimes of speed against error
// (scripts/measure.sh) at the start of their first window, one scene and many copies. Times are the device's.
//
// Usage: gem_cuda_splitting CASES_FOLDER [copies]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "gem/field/field.h"
#include "gem_version.h"
#include "gpu_phases.h"

namespace gem {
namespace {

constexpr double timed = 6.4;  // [s]
constexpr Phase regimes[] = {
    {"drift", "004_400_25", 60.0}, {"plug", "400_300_100", 600.0}, {"jam", "400_200_100", 600.0}};

struct Setting {
  const char* name;
  Iteration iteration;
  std::int64_t iterations;  ///< At most; 0: the default.
  double steps;             ///< Time steps of the case that one takes, dt.
};
constexpr Setting settings[] = {{"gradient 32 dt", Iteration::gradient, 32, 1.0},
                                {"gradient 200 dt", Iteration::gradient, 200, 1.0},
                                {"splitting dt", Iteration::splitting, 0, 1.0},
                                {"splitting 4dt", Iteration::splitting, 0, 4.0}};

/// Moves copies of a state on and prints the milliseconds per simulated second of all of them.
void time_setting(const Phase& phase, SceneDef scene, const Bodies& field, EngineState start, const Setting& setting,
                  std::size_t copies) {
  scene.contact.solver = ContactSolver::coupled;
  scene.numerics.iteration = setting.iteration;
  const IterationEnd end = default_end(setting.iteration);
  scene.numerics.iterations_maximum = setting.iterations > 0 ? setting.iterations : end.iterations_maximum;
  scene.numerics.residual_tolerance = end.residual_tolerance;
  scene.numerics.time_step_s *= setting.steps;
  start.step = steps_in(scene, phase.time);
  CudaBatch batch(std::vector<BatchScene>(copies, {scene, field}), {});
  const std::int64_t steps = steps_in(scene, timed);
  std::vector<double> seconds;
  std::vector<StepLog> logs(copies);
  for (int repetition = 0; repetition < 3; ++repetition) {
    for (std::size_t k = 0; k < copies; ++k) batch.restore(k, start);
    batch.advance(2, nullptr);  // builds the list
    for (StepLog& log : logs) log.clear();
    batch.advance(steps, &logs);
    if (repetition > 0) seconds.push_back(batch.device_time());
  }
  std::sort(seconds.begin(), seconds.end());
  double contacts = 0.0, iterations = 0.0;
  for (const StepQuality& quality : logs[0].quality) {
    contacts += static_cast<double>(quality.contacts) / static_cast<double>(steps);
    iterations += static_cast<double>(quality.iterations) / static_cast<double>(steps);
  }
  std::printf("%s,%s,%s,%s,%zu,%.3f,%.3f,%.0f,%.1f,%s,%016llx\n", GEM_COMMIT, batch.device().name.c_str(), phase.name,
              setting.name, copies, 1e3 * seconds[seconds.size() / 2] / timed,
              1e3 * (seconds.back() - seconds.front()) / timed, contacts, iterations,
              batch.route() == Route::phases ? "phases" : "resident",
              static_cast<unsigned long long>(batch.state_hash(0)));
  std::fflush(stdout);
}

void time_all(const std::string& cases, std::size_t copies) {
  std::printf("commit,device,phase,setting,scenes,ms_per_s,spread,contacts,iterations,route,state_hash\n");
  for (const Phase& phase : regimes) {
    const SceneDef scene = scene_of(cases, phase.run);
    const Bodies field = make_field(scene);
    const EngineState start = start_of(phase, scene, field);
    for (const std::size_t count : {std::size_t{1}, copies})
      for (const Setting& setting : settings) time_setting(phase, scene, field, start, setting, count);
  }
}

}  // namespace
}  // namespace gem

int main(int count, char** argument) {
  try {
    gem::time_all(count > 1 ? argument[1] : "cases", count > 2 ? std::strtoul(argument[2], nullptr, 10) : 36);
    return 0;
  } catch (const gem::Error& error) {
    std::fprintf(stderr, "gem_cuda_splitting: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
