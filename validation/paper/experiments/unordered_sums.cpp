// Repeats of one case with sums in single precision without a fixed order, beside the unchanged case and copies in
// which one floe is shifted slightly: the distance between their platforms over time, and the size of the differences
// in a time step.
//
// Usage: unordered_sums CASE SECONDS THREADS RUNS.csv DISTANCES.csv
//   The rows in validation/paper are from: cases/004_400_25.toml 7200 2, written to unordered_runs.csv and
//   unordered_distances.csv; 26 minutes on two busy cores. scripts/paper_report.sh reads them.
//   RUNS       one row per run: settings, state hash, swing, differences of its sums in single precision
//   (SumStatistics)
//   DISTANCES  one row per 2 s, one column per pair "contacts:sums:run-run" (run 0: sums in double precision, in
//   order):
//              distance of the platforms in position and in velocity over the natural frequency [m]
#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "gem/analysis/statistics/moments.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/field.h"
#include "gem/scene/toml/scene_file.h"
#include "gem_version.h"
#include "validation/paper/experiments/study_program.h"
#include "validation/paper/experiments/unordered_engine.h"

namespace gem::repeats {
namespace {

constexpr double kInterval = 2.0;       // between the samples of a path [s]
constexpr const char* kMoved = "1e-9";  // [m]

struct Planned {
  std::string contacts;  // independent or coupled
  std::string sums;      // ordered; zero or velocity (SumStart); "moved 1e-9": ordered, one floe moved so far [m]
  int run = 0;           // number of the repeat, or of the shifted floe counted from the platform; 0: unchanged
};

bool moved(const Planned& run) { return run.sums.starts_with("moved"); }

struct Path {
  std::vector<Vec2> place, velocity;  // position [m], velocity over the natural frequency [m]
};

struct Done {
  Path path;
  std::uint64_t hash = 0;
  SumStatistics statistics;
};

std::vector<Planned> plan() {
  std::vector<Planned> runs;
  for (const std::string contacts : {"independent", "coupled"}) {
    const bool independent = contacts == "independent";
    runs.push_back({contacts, "ordered", 0});
    for (int k = 1; k <= 6; ++k) runs.push_back({contacts, "zero", k});
    for (int k = 1; k <= 6 && independent; ++k) runs.push_back({contacts, "velocity", k});
    for (const int floe : {50, 100, 150, 200}) runs.push_back({contacts, std::string("moved ") + kMoved, floe});
  }
  return runs;
}

/// The paper's settings; where it is silent, those that `independent` needs: gem/manual/user_guide.md, "the paper's
/// method".
SceneDef scene_of(const Planned& run, const std::string& file) {
  std::vector<std::string> settings = {"ice.friction_ice=0.1", "contact.solver=\"" + run.contacts + "\""};
  if (run.contacts == "independent") settings.push_back("contact.manifold=\"chord_middle\"");
  if (moved(run)) {
    settings.push_back("floes.moved_floe=" + std::to_string(run.run));
    settings.push_back(std::string("floes.moved_by_m=[") + kMoved + ", 0.0]");
  }
  return read_scene(file, settings);
}

Done carried_out(const Planned& run, const std::string& file, double seconds) {
  const SceneDef scene = scene_of(run, file);
  Bodies bodies = make_field(scene);
  const double frequency = std::sqrt(scene.mooring.stiffness_N_per_m / scene.platform.mass_kg);
  const bool in_order = run.sums == "ordered" || moved(run);
  std::unique_ptr<CpuEngine> engine;
  UnorderedEngine* unordered = nullptr;
  if (in_order) {
    engine = std::make_unique<CpuEngine>(scene, std::move(bodies), 1, EngineOptions{}.contacts_worth_a_thread);
  } else {
    const SumStart start = run.sums == "zero" ? SumStart::zero : SumStart::velocity;
    auto made = std::make_unique<UnorderedEngine>(scene, std::move(bodies), start, run.run);
    unordered = made.get();
    engine = std::move(made);
  }
  Done done;
  const auto note = [&](Vec2 place, Vec2 velocity) {
    done.path.place.push_back(place);
    done.path.velocity.push_back((1.0 / frequency) * velocity);
  };
  note(engine->bodies().position[0], engine->bodies().velocity[0]);
  const std::int64_t step = std::llround(kInterval / scene.numerics.time_step_s);
  for (double time = 0.0; time < seconds; time += kInterval) {
    StepLog log;
    log.wants_events = false;
    engine->advance(step, log);
    note(log.platform.back().position, log.platform.back().velocity);
  }
  done.hash = engine->state_hash();
  if (unordered != nullptr) done.statistics = unordered->statistics();
  return done;
}

double distance(const Path& a, const Path& b, std::size_t i) {
  const Vec2 place = a.place[i] - b.place[i], velocity = a.velocity[i] - b.velocity[i];
  return std::sqrt(dot(place, place) + dot(velocity, velocity));
}

std::string run_row(const Planned& run, const Done& done) {
  std::vector<double> x;
  for (const Vec2 place : done.path.place) x.push_back(place.x);
  const SumStatistics& s = done.statistics;
  const auto root_mean = [](double squares, std::int64_t count) {
    return number_text(count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0, 4);
  };
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(done.hash));
  std::string row = run.contacts + "," + run.sums + "," + std::to_string(run.run) + "," + hash + "," +
                    number_text(moments(x).deviation, 6);
  for (const std::int64_t count : {s.sums, s.several, s.changed}) row += "," + std::to_string(count);
  row += "," + root_mean(s.order_squares, s.several) + "," + number_text(s.order_largest, 4);
  row += "," + root_mean(s.rounding_squares, s.sums) + "," + number_text(s.rounding_largest, 4);
  row += "," + std::to_string(s.platform_sums) + "," + root_mean(s.platform_squares, s.platform_sums);
  return row + "," GEM_COMMIT "\n";
}

struct Pair {
  std::size_t a, b;
};

/// Pairs of runs to compare: each with the ordered run, and repeats with each other, each repeat in one such pair. Runs
/// that add to the velocity differ from the ordered run by rounding from the start, which says nothing about repeats;
/// they are only paired with each other.
std::vector<Pair> pairs_of(const std::vector<Planned>& runs) {
  std::vector<Pair> pairs;
  std::size_t ordered = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].sums == "ordered") {
      ordered = i;
      continue;
    }
    if (runs[i].sums != "velocity") pairs.push_back({i, ordered});
    if (!moved(runs[i]) && runs[i].run % 2 == 0) pairs.push_back({i - 1, i});
  }
  return pairs;
}

std::string distances_text(const std::vector<Planned>& runs, const std::vector<Done>& done) {
  const std::vector<Pair> pairs = pairs_of(runs);
  std::string text = "t_s";
  for (const Pair& pair : pairs)
    text += "," + runs[pair.a].contacts + ":" + runs[pair.a].sums + ":" + std::to_string(runs[pair.a].run) + "-" +
            std::to_string(runs[pair.b].run);
  text += "\n";
  for (std::size_t i = 0; i < done.front().path.place.size(); ++i) {
    text += number_text(kInterval * static_cast<double>(i));
    for (const Pair& pair : pairs) text += "," + number_text(distance(done[pair.a].path, done[pair.b].path, i), 3);
    text += "\n";
  }
  return text;
}

}  // namespace

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 5)
    throw Error(ExitCode::usage, "wrong arguments (not CASE SECONDS THREADS RUNS.csv DISTANCES.csv); give these five");
  const double seconds = study::positive(arguments[1]), threads = study::positive(arguments[2]);
  const std::vector<Planned> runs = plan();
  for (const Planned& one : runs) scene_of(one, arguments[0]);  // an error in the case shows here, not in a thread
  std::vector<Done> done(runs.size());
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> team;
  for (int t = 0; t < threads; ++t)
    team.emplace_back([&] {
      for (std::size_t i = next++; i < runs.size(); i = next++) {
        done[i] = carried_out(runs[i], arguments[0], seconds);
        std::cerr << run_row(runs[i], done[i]);
      }
    });
  team.clear();
  std::string rows =
      "contacts,sums,run,state_hash,x_deviation_m,sums_taken,sums_of_several,sums_changed,order_rms,order_largest,"
      "rounding_rms,rounding_largest,platform_sums,platform_order_rms_m_per_s,commit\n";
  for (std::size_t i = 0; i < runs.size(); ++i) rows += run_row(runs[i], done[i]);
  study::write(arguments[3], rows);
  study::write(arguments[4], distances_text(runs, done));
  return 0;
}

}  // namespace gem::repeats

int main(int argc, char** argv) { return gem::study::exit_code_of("unordered_sums", argc, argv, gem::repeats::run); }
