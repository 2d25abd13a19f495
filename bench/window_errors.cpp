// Errors of short windows against a fine reference, and their cost. The reference runs through consecutive windows.
// Every setting starts each window from the reference's state, so that chaos has no time to hide the error.
//
// Usage: window_errors CASE NAME START_S SETTLE_S WINDOWS WINDOW_S INSTANTS REPETITIONS SETTINGS ERRORS.csv PATHS.csv
//   CASE         case file; a member of a sweep as FILE#INDEX
//   NAME         of the regime, for the rows: drift, plug, jam
//   START_S      start of the first window
//   SETTLE_S     gem's cpu engine with the numerics of the case runs to START_S - SETTLE_S, the reference from there,
//   so
//                that the reference's own contacts have settled
//   INSTANTS     number of instants per window, evenly spaced, at which positions are compared
//   REPETITIONS  timed runs of every window; settings take turns, so that other load affects all of them. 0: the judged
//                run is timed. The reference is timed once, as it goes
//   SETTINGS     see bench/setting.h; the first line is the reference
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "bench/overlaps.h"
#include "bench/setting.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/field.h"
#include "gem_version.h"

namespace gem::bench {
namespace {

struct Task {
  CaseChoice chosen_case;
  std::string name;
  double start = 0.0, settle = 0.0;  // [s]
  int windows = 1;
  double window = 30.0;  // [s]
  int instants = 10;
  int repetitions = 3;
  std::string settings, errors, paths;
};

/// What one setting did in one window.
struct Judged {
  std::vector<Bodies> at;  // the field at each instant
  Vec2 mean_force;         // of the ice on the platform [N]
  Overlaps deepest;
  std::uint64_t hash = 0;
  std::vector<double> user, wall;  // of the timed runs [s]
};

/// Runs an engine through the window; only the engine is timed.
Judged judged(Engine& engine, const EngineSetting& setting, const Task& task) {
  Judged result;
  const std::int64_t first = engine.step(), steps = steps_in(setting, task.window);
  Vec2 impulse;
  Spent spent;
  for (int k = 1; k <= task.instants; ++k) {
    StepLog log;
    log.wants_events = false;
    const Spent before = spent_so_far();
    engine.advance(first + steps * k / task.instants - engine.step(), log);
    spent += spent_so_far() - before;
    for (const PlatformStep& step : log.platform) impulse += step.ice_impulse;
    result.at.push_back(engine.bodies());
  }
  const Overlaps last = overlaps_of(engine.bodies());
  result.deepest = last;
  result.mean_force = (1.0 / task.window) * impulse;
  result.hash = engine.state_hash();
  result.user.push_back(spent.user);
  result.wall.push_back(spent.wall);
  return result;
}

void time_again(Judged& result, const EngineSetting& setting, const Start& start, const Task& task) {
  const auto engine = engine_at(setting, start);
  StepLog log;
  log.wants_events = false;
  const Spent before = spent_so_far();
  engine->advance(steps_in(setting, task.window), log);
  const Spent spent = spent_so_far() - before;
  result.user.push_back(spent.user);
  result.wall.push_back(spent.wall);
  if (engine->state_hash() != result.hash)
    throw Error(ExitCode::numerical_stop, setting.label +
                                              " gave other bits when repeated (its engine is not "
                                              "deterministic); find out why");
}

/// Root mean square distance over the instants, for all floes and for the platform [m].
struct PathError {
  double floes = 0.0, platform = 0.0, all = 0.0;
};

PathError path_error(const Judged& judged, const Judged& reference) {
  double floes = 0.0, platform = 0.0, all = 0.0;
  const double instants = static_cast<double>(judged.at.size());
  for (std::size_t k = 0; k < judged.at.size(); ++k) {
    const FloeDistance apart = floe_distance(judged.at[k], reference.at[k]);
    const Vec2 moved = judged.at[k].position[0] - reference.at[k].position[0];
    floes += apart.rms * apart.rms / instants;
    platform += dot(moved, moved) / instants;
    all += (apart.rms * apart.rms * apart.count + dot(moved, moved)) / (apart.count + 1.0) / instants;
  }
  return {std::sqrt(floes), std::sqrt(platform), std::sqrt(all)};
}

class Tables {
 public:
  explicit Tables(const Task& task) : task_(task), errors_(task.errors), paths_(task.paths) {
    if (!errors_ || !paths_)
      throw Error(ExitCode::file_system, "cannot write " + task.errors + " or " + task.paths +
                                             " (one does not open) "
                                             "name other files");
    errors_ << "case,regime,window,start_s,window_s,setting,engine,moment_s,user_s_per_s,wall_s_per_s,floes_rms_m,"
               "platform_rms_m,all_rms_m,ice_force_x_N,reference_ice_force_x_N,overlap_maximum_m,overlap_999_m,"
               "repetitions,state_hash,commit\n";
    paths_ << "case,regime,window,setting,time_s,floes_rms_m,floes_largest_m,platform_m\n";
  }

  void add(int window, double start, const EngineSetting& setting, const Judged& judged, const Judged& reference) {
    const PathError error = path_error(judged, reference);
    const std::string who = setting.scene.run.name + "," + task_.name + "," + std::to_string(window) + ",";
    errors_ << who << number_text(start) << ',' << number_text(task_.window) << ',' << setting.label << ','
            << setting.engine.name;
    for (const double value :
         {setting.scene.numerics.time_step_s, median(judged.user) / task_.window, median(judged.wall) / task_.window,
          error.floes, error.platform, error.all, judged.mean_force.x, reference.mean_force.x, judged.deepest.maximum,
          judged.deepest.quantile_999, static_cast<double>(judged.user.size())})
      errors_ << ',' << number_text(value, 6);
    errors_ << ',' << hex(judged.hash) << ',' << GEM_COMMIT << std::endl;
    for (std::size_t k = 0; k < judged.at.size(); ++k) {
      const FloeDistance apart = floe_distance(judged.at[k], reference.at[k]);
      const double time = task_.window * static_cast<double>(k + 1) / static_cast<double>(judged.at.size());
      paths_ << who << setting.label << ',' << number_text(time, 6) << ',' << number_text(apart.rms, 5) << ','
             << number_text(apart.largest, 5) << ','
             << number_text(length(judged.at[k].position[0] - reference.at[k].position[0]), 5) << std::endl;
    }
  }

 private:
  const Task& task_;
  std::ofstream errors_, paths_;
};

/// The reference's engine at the start of the first window.
std::unique_ptr<Engine> settled_reference(const EngineSetting& reference, const Task& task) {
  SceneDef scene = with_floes_of_run_file(read_case(task.chosen_case));
  scene.contact.solver = ContactSolver::coupled;
  scene.numerics.iteration = Iteration::gradient;  // it only leads to the window, and is many times cheaper in a jam
  const auto lead = make_engine(scene, make_field(scene), {"cpu", 1});
  const double step = scene.numerics.time_step_s, led = task.start - task.settle;
  const std::int64_t last = std::llround(led / step);
  while (lead->step() < last) {
    StepLog log;
    log.wants_events = false;
    lead->advance(std::min<std::int64_t>(100, last - lead->step()), log);
  }
  auto engine = engine_at(reference, {lead->save(), step, led});
  StepLog log;
  log.wants_events = false;
  engine->advance(steps_in(reference, task.start) - engine->step(), log);
  return engine;
}

void check_steps(const std::vector<EngineSetting>& settings, const Task& task) {
  for (const EngineSetting& setting : settings) {
    const double steps = task.window / static_cast<double>(task.instants) / setting.scene.numerics.time_step_s;
    if (std::fabs(steps - std::round(steps)) > 1e-6 || steps < 0.5)
      throw Error(ExitCode::usage, setting.label + ": its moment of " +
                                       number_text(setting.scene.numerics.time_step_s) +
                                       " s does not divide the time between instants (places would be compared at "
                                       "different times); choose WINDOW_S and INSTANTS accordingly");
  }
}

void measure(const Task& task) {
  const std::vector<EngineSetting> settings = read_settings(task.settings, task.chosen_case);
  if (settings.size() < 2)
    throw Error(ExitCode::usage, task.settings + ": fewer than two settings (nothing to compare); add one");
  check_steps(settings, task);
  Tables tables(task);
  const EngineSetting& reference = settings.front();
  const auto lead = settled_reference(reference, task);
  for (int w = 0; w < task.windows; ++w) {
    const double time = task.start + w * task.window;
    const Start start{lead->save(), reference.scene.numerics.time_step_s, time};
    const Judged truth = judged(*lead, reference, task);
    std::vector<Judged> results;
    for (std::size_t k = 1; k < settings.size(); ++k) {
      const auto engine = engine_at(settings[k], start);
      results.push_back(judged(*engine, settings[k], task));
      if (task.repetitions > 0) results.back().user.clear(), results.back().wall.clear();
    }
    const std::size_t count = results.size();
    for (int repetition = 0; repetition < task.repetitions; ++repetition)
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t turn = (k + static_cast<std::size_t>(repetition)) % count;
        time_again(results[turn], settings[turn + 1], start, task);
      }
    tables.add(w, time, reference, truth, truth);
    for (std::size_t k = 0; k < count; ++k) tables.add(w, time, settings[k + 1], results[k], truth);
  }
}

int run(const std::vector<std::string>& a) {
  if (a.size() != 11) throw Error(ExitCode::usage, "eleven arguments are needed (see the head of the source)");
  const auto whole = [&](std::size_t k, const char* what) { return static_cast<int>(number_of(a[k], what)); };
  const Task task{case_named(a[0]),
                  a[1],
                  number_of(a[2], "START_S"),
                  number_of(a[3], "SETTLE_S"),
                  whole(4, "WINDOWS"),
                  number_of(a[5], "WINDOW_S"),
                  whole(6, "INSTANTS"),
                  whole(7, "REPETITIONS"),
                  a[8],
                  a[9],
                  a[10]};
  if (!(task.settle >= 0.0 && task.start >= task.settle && task.windows > 0 && task.window > 0.0 && task.instants > 0 &&
        task.repetitions >= 0))
    throw Error(ExitCode::usage,
                "START_S >= SETTLE_S >= 0, a window, an instant and no negative number of repetitions "
                "are needed (values out of range); correct them");
  measure(task);
  return 0;
}

}  // namespace
}  // namespace gem::bench

int main(int argc, char** argv) { return gem::bench::run_program("window_errors", gem::bench::run, argc, argv); }
