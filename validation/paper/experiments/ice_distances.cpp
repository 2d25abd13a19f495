// Run 1 beside copies in which one floe is shifted slightly: the distance between the ice of both, over time.
//
// Usage: ice_distances CASE SECONDS THREADS DISTANCES.csv
//   The rows in validation/paper are from: cases/004_400_25.toml 1800 2 validation/paper/ice_distances.csv.
//   scripts/paper_report.sh reads them.
//   DISTANCES  one row per 2 s, one column per pair "contacts:moved:seed": root mean square distance between the floes
//              that are active in both runs [m]; the last row names the commit
#include <atomic>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem/record/schema.h"
#include "gem/scene/toml/scene_file.h"
#include "gem_version.h"
#include "validation/paper/experiments/study_program.h"

namespace gem::ice {
namespace {

constexpr double kInterval = 2.0;  // between samples [s]
constexpr int kSeeds = 5;
const std::vector<std::string> kMoves = {"1e-9", "1e-7", "1e-5", "1e-3"};  // [m]

/// One field and its disturbed copies, one for each of kMoves.
struct Planned {
  std::string contacts;  // independent or coupled
  int seed = 1;
};

using Distances = std::vector<std::vector<double>>;  // of each copy, one per sample [m]

SceneDef scene_of(const Planned& plan, const std::string& moved, const std::string& file) {
  std::vector<std::string> settings = {"contact.solver=\"" + plan.contacts + "\"",
                                       "run.seed=" + std::to_string(plan.seed)};
  if (plan.contacts == "independent")
    settings.insert(settings.end(), {"contact.manifold=\"chord_middle\"", "contact.friction_law=\"fixed_direction\""});
  if (!moved.empty())
    settings.insert(settings.end(), {"floes.moved_floe=100", "floes.moved_by_m=[" + moved + ", 0.0]"});
  return read_scene(file, settings);
}

double distance(const Bodies& a, const Bodies& b) {
  double squares = 0.0, count = 0.0;
  for (std::size_t i = first_floe(a); i < a.count(); ++i) {
    if (!a.active[i] || !b.active[i]) continue;
    const Vec2 apart = a.position[i] - b.position[i];
    squares += dot(apart, apart);
    ++count;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

Distances carried_out(const Planned& plan, const std::string& file, double seconds) {
  std::vector<std::unique_ptr<Engine>> engines;
  EngineOptions options;
  options.threads = 1;
  const SceneDef scene = scene_of(plan, "", file);
  engines.push_back(make_engine(scene, make_field(scene), options));
  for (const std::string& moved : kMoves) {
    const SceneDef other = scene_of(plan, moved, file);
    engines.push_back(make_engine(other, make_field(other), options));
  }
  Distances distances(kMoves.size());
  const std::int64_t step = std::llround(kInterval / scene.numerics.time_step_s);
  const auto note = [&] {
    for (std::size_t k = 0; k < kMoves.size(); ++k)
      distances[k].push_back(distance(engines[0]->bodies(), engines[k + 1]->bodies()));
  };
  note();
  for (double time = 0.0; time < seconds; time += kInterval) {
    for (const auto& engine : engines) {
      StepLog log;
      log.wants_events = false;
      engine->advance(step, log);
    }
    note();
  }
  return distances;
}

std::string distances_text(const std::vector<Planned>& plans, const std::vector<Distances>& done) {
  std::string text = "t_s";
  for (const Planned& plan : plans)
    for (const std::string& moved : kMoves) text += "," + plan.contacts + ":" + moved + ":" + std::to_string(plan.seed);
  text += "\n";
  for (std::size_t i = 0; i < done.front().front().size(); ++i) {
    text += number_text(kInterval * static_cast<double>(i));
    for (const Distances& distances : done)
      for (const std::vector<double>& one : distances) text += "," + number_text(one[i], 3);
    text += "\n";
  }
  return text + "commit," GEM_COMMIT "\n";
}

}  // namespace

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 4)
    throw Error(ExitCode::usage, "wrong arguments (not CASE SECONDS THREADS DISTANCES.csv); give these four");
  const double seconds = study::positive(arguments[1]), threads = study::positive(arguments[2]);
  std::vector<Planned> plans;
  for (const char* contacts : {"coupled", "independent"})
    for (int seed = 1; seed <= kSeeds; ++seed) plans.push_back({contacts, seed});
  scene_of(plans.front(), kMoves.front(), arguments[0]);  // an error in the case shows here, not in a thread
  std::vector<Distances> done(plans.size());
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> team;
  for (int t = 0; t < threads; ++t)
    team.emplace_back([&] {
      for (std::size_t i = next++; i < plans.size(); i = next++) {
        done[i] = carried_out(plans[i], arguments[0], seconds);
        std::cerr << "ice_distances: " << plans[i].contacts << ", seed " << plans[i].seed << " done\n";
      }
    });
  team.clear();
  study::write(arguments[3], distances_text(plans, done));
  return 0;
}

}  // namespace gem::ice

int main(int argc, char** argv) { return gem::study::exit_code_of("ice_distances", argc, argv, gem::ice::run); }
