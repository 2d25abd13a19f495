// Speed of the cuda engine, measured with device events, as CSV: one scene in three phases and several layouts, and
// batches.
//
// Usage: gem_cuda_speed CASES_FOLDER [single|copies|batch|table|growth|profile|all] [largest batch]
//                       [coupled|independent] [phase]
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "gem/field/field.h"
#include "gem_version.h"
#include "gpu_phases.h"
#include "growth_field.h"

namespace gem {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t timed_steps = 256;

/// What is measured.
struct Subject {
  std::string cases = "cases";
  ContactSolver solver = ContactSolver::coupled;
  std::string phase = {};  // empty: all
  const char* name() const { return solver_name(solver); }
};

/// A run of the paper with the default settings, or with independent contacts as in the results of that solver.
SceneDef scene_of(const Subject& subject, const std::string& run) {
  SceneDef scene = gem::scene_of(subject.cases, run);
  scene.contact.solver = subject.solver;
  if (subject.solver == ContactSolver::independent) scene.contact.manifold = Manifold::chord_middle;
  return scene;
}

/// Ends a row with the route and the number of barriers in a time step.
void end_row(const CudaBatch& batch) {
  std::printf(",%s,%.2f\n", batch.route() == Route::phases ? "phases" : "resident", batch.barriers());
  std::fflush(stdout);
}

void header() {
  std::printf(
      "commit,device,resolution,measure,phase,scenes,blocks,threads,microseconds_per_moment,spread,"
      "x_real_time,contacts,wall_over_device,state_hash,launches,barriers\n");
}

struct Timing {
  double median = 0.0, spread = 0.0, wall = 0.0;
};

Timing time_steps(CudaBatch& batch, const EngineState& start, std::vector<StepLog>* logs, int repetitions) {
  std::vector<double> seconds;
  double wall = 0.0;
  for (int k = 0; k < repetitions + 1; ++k) {
    for (std::size_t s = 0; s < batch.size(); ++s) batch.restore(s, start);
    batch.advance(2, nullptr);  // builds the pair list
    if (logs)
      for (StepLog& log : *logs) log.clear();
    const auto begin = Clock::now();
    batch.advance(timed_steps, logs);
    if (k == 0) continue;  // warm-up
    wall += std::chrono::duration<double>(Clock::now() - begin).count() / repetitions;
    seconds.push_back(batch.device_time() / double(timed_steps));
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.back() - seconds.front(), wall / double(timed_steps)};
}

void single(const Subject& subject) {
  for (const Phase& phase : phases) {
    if (!subject.phase.empty() && subject.phase != phase.name) continue;
    const SceneDef scene = scene_of(subject, phase.run);
    const Bodies field = make_field(scene);
    const EngineState start = start_of(phase, scene, field);
    for (const int blocks : {1, 4, 16, 64, 112, 132})
      for (const int threads : {128, 256}) {
        if ((blocks < 64 && threads < 256) || blocks > usable_cuda_device().multiprocessors) continue;
        CudaBatch timed({{scene, field}}, {.blocks = blocks, .threads = threads});
        std::vector<StepLog> logs(1);
        const Timing time = time_steps(timed, start, &logs, 7);
        double contacts = 0.0;
        for (const StepQuality& quality : logs[0].quality) contacts += quality.contacts / double(timed_steps);
        std::printf("%s,%s,%s,moment,%s,1,%d,%d,%.3f,%.3f,%.0f,%.0f,%.2f,%016llx", GEM_COMMIT,
                    timed.device().name.c_str(), subject.name(), phase.name, blocks, threads, 1e6 * time.median,
                    1e6 * time.spread, scene.numerics.time_step_s / time.median, contacts, time.wall / time.median,
                    static_cast<unsigned long long>(timed.state_hash(0)));
        end_row(timed);
      }
  }
}

/// Many copies of a scene in one phase, to fill the device.
void copies(const Subject& subject, std::size_t largest) {
  for (const Phase& phase : phases) {
    if (!subject.phase.empty() && subject.phase != phase.name) continue;
    const SceneDef scene = scene_of(subject, phase.run);
    const Bodies field = make_field(scene);
    const EngineState start = start_of(phase, scene, field);
    for (const std::size_t count : {36, 66}) {
      if (count > largest) break;
      CudaBatch timed(std::vector<BatchScene>(count, {scene, field}), {.samples = false});
      const Timing time = time_steps(timed, start, nullptr, 3);
      std::printf("%s,%s,%s,copies,%s,%zu,%d,%d,%.3f,%.3f,%.0f,,%.2f,%016llx", GEM_COMMIT, timed.device().name.c_str(),
                  subject.name(), phase.name, count, timed.blocks(), timed.threads(), 1e6 * time.median,
                  1e6 * time.spread, double(count) * scene.numerics.time_step_s / time.median, time.wall / time.median,
                  static_cast<unsigned long long>(timed.state_hash(count - 1)));
      end_row(timed);
    }
  }
}

/// For a profiler: `count` copies of a phase with their lists built, then one launch of 16 time steps.
void one_launch(const Subject& subject, std::size_t count) {
  for (const Phase& phase : phases) {
    if (!subject.phase.empty() && subject.phase != phase.name) continue;
    const SceneDef scene = scene_of(subject, phase.run);
    const Bodies field = make_field(scene);
    const EngineState start = start_of(phase, scene, field);
    CudaBatch batch(std::vector<BatchScene>(count, {scene, field}), {});
    for (std::size_t k = 0; k < count; ++k) batch.restore(k, start);
    batch.advance(2, nullptr);
    batch.advance(2, nullptr);
    batch.advance(16, nullptr);
  }
}

/// Fields of the main run with seeds 1, 2, ...
std::vector<BatchScene> seeds(const Subject& subject, std::size_t count) {
  std::vector<BatchScene> scenes(count);
  const SceneDef scene = scene_of(subject, "004_400_25");
  std::vector<std::thread> threads;
  const std::size_t workers = std::max(1U, std::thread::hardware_concurrency());
  for (std::size_t w = 0; w < workers; ++w)
    threads.emplace_back([&, w] {
      for (std::size_t k = w; k < count; k += workers) {
        scenes[k].scene = scene;
        scenes[k].scene.run.seed = 1 + k;
        scenes[k].bodies = make_field(scenes[k].scene);
      }
    });
  for (std::thread& thread : threads) thread.join();
  return scenes;
}

/// Advances each scene of a batch by its `steps` and prints the time per step of the longest. `recorded`: with the
/// record of every time step.
void time_batch(const Subject& subject, const char* measure, const std::vector<BatchScene>& scenes,
                const std::vector<std::int64_t>& steps, bool recorded) {
  double simulated = 0.0;
  for (std::size_t k = 0; k < scenes.size(); ++k) simulated += double(steps[k]) * scenes[k].scene.numerics.time_step_s;
  const std::int64_t longest = *std::max_element(steps.begin(), steps.end());
  CudaBatch batch(scenes, {.samples = recorded});
  std::vector<StepLog> logs(scenes.size());
  const auto begin = Clock::now();
  batch.advance(steps, recorded ? &logs : nullptr);
  const double wall = std::chrono::duration<double>(Clock::now() - begin).count(), device = batch.device_time();
  std::printf("%s,%s,%s,%s,%lld moments,%zu,%d,%d,%.3f,,%.0f,,%.2f,%016llx", GEM_COMMIT, batch.device().name.c_str(),
              subject.name(), measure, static_cast<long long>(longest), scenes.size(), batch.blocks(), batch.threads(),
              1e6 * device / double(longest), simulated / wall, wall / device,
              static_cast<unsigned long long>(batch.state_hash(0)));
  end_row(batch);
}

void batches(const Subject& subject, std::size_t largest) {
  constexpr double duration = 600.0;  // [s]
  const std::vector<BatchScene> all = seeds(subject, largest);
  for (std::size_t count : {1, 8, 33, 66, 132, 264}) {
    if (count > largest) break;
    const std::vector<BatchScene> some(all.begin(), all.begin() + std::ptrdiff_t(count));
    const std::vector<std::int64_t> steps(count, steps_in(some[0].scene, duration));
    time_batch(subject, "batch", some, steps, false);
    time_batch(subject, "batch_recorded", some, steps, true);
  }
}

/// All runs of Table 1 in one batch, with the record of every time step: first the same number of time steps for each
/// run, then a twelfth of each run.
void table(const Subject& subject) {
  std::vector<BatchScene> scenes;
  for (const SweepMember& member : expand_sweep(subject.cases + "/table1.toml")) {
    const SceneDef scene = scene_of(subject, member.name);
    scenes.push_back({scene, make_field(scene)});
  }
  std::vector<std::int64_t> twelfth;
  for (const BatchScene& run : scenes) twelfth.push_back(steps_in(run.scene, run.scene.run.duration_s / 12));
  time_batch(subject, "table1_recorded", scenes,
             std::vector<std::int64_t>(scenes.size(), steps_in(scenes[0].scene, 1200.0)), true);
  time_batch(subject, "table1_twelfth_recorded", scenes, twelfth, true);
}

/// One scene of many floes.
void growth(const Subject& subject) {
  for (const std::int64_t count : {1000, 10000, 100000, 1000000, 4000000}) {
    auto [scene, bodies] = growth_field(count);
    scene.contact.solver = subject.solver;
    if (subject.solver == ContactSolver::independent) scene.contact.manifold = Manifold::chord_middle;
    CudaBatch batch({{scene, bodies}}, {.samples = false});
    batch.advance(100, nullptr);
    const EngineState start = batch.save(0);
    const Timing time = time_steps(batch, start, nullptr, 3);
    std::printf("%s,%s,%s,growth,%lld floes,1,%d,%d,%.3f,%.3f,%.0f,,%.2f,%016llx", GEM_COMMIT,
                batch.device().name.c_str(), subject.name(), static_cast<long long>(count), batch.blocks(),
                batch.threads(), 1e6 * time.median, 1e6 * time.spread, scene.numerics.time_step_s / time.median,
                time.wall / time.median, static_cast<unsigned long long>(batch.state_hash(0)));
    end_row(batch);
  }
}

std::size_t scenes_of(const std::string& text) {
  std::size_t scenes = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), scenes);
  if (error != std::errc{} || end != text.data() + text.size() || scenes < 1 || scenes > 4096)
    throw Error(ExitCode::usage, "'" + text + "' is no number of scenes (1 to 4096)");
  return scenes;
}

void check_word(const std::string& word, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), word) != known.end()) return;
  std::string all;
  for (const std::string& one : known) all += " " + one;
  throw Error(ExitCode::usage, "'" + word + "' is not known (one of" + all + "); see the top of bench/cuda_speed.cpp");
}

}  // namespace
}  // namespace gem

int main(int count, char** argument) {
  try {
    const std::string what = count > 2 ? argument[2] : "all", solver = count > 4 ? argument[4] : "coupled";
    gem::Subject subject;
    if (count > 1) subject.cases = argument[1];
    if (count > 5) subject.phase = argument[5];
    if (!subject.phase.empty()) gem::check_word(subject.phase, {"drift", "plug", "jam"});
    if (solver == "independent") subject.solver = gem::ContactSolver::independent;
    const std::size_t largest = count > 3 ? gem::scenes_of(argument[3]) : 264;
    gem::check_word(what, {"single", "copies", "batch", "table", "growth", "profile", "all"});
    gem::check_word(solver, {"coupled", "independent"});
    gem::header();
    if (what == "profile") gem::one_launch(subject, largest);
    if (what == "single" || what == "all") gem::single(subject);
    if (what == "copies" || what == "all") gem::copies(subject, largest);
    if (what == "batch" || what == "all") gem::batches(subject, largest);
    if (what == "table" || what == "all") gem::table(subject);
    if (what == "growth" || what == "all") gem::growth(subject);
    return 0;
  } catch (const gem::Error& error) {
    std::fprintf(stderr, "gem_cuda_speed: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
