// Speed and error of engines and settings. Every setting starts from the same state of one case, runs the same window,
// and is judged outside the engine. Prints CSV.
//
// Usage: speed_against_error CASE START_S WINDOW_S REPETITIONS SETTINGS [REFERENCE [LEADER]]
//   CASE          case file; a member of a sweep as FILE#INDEX
//   START_S       start of the window; several in ascending order, separated by commas
//   REPETITIONS   timed runs; 0: the judged run is timed
//   SETTINGS      file with one setting per line, see bench/setting.h
//   REFERENCE     label of the setting whose end positions are the reference; it is not timed; - for none
//   LEADER        label of the setting that runs to START_S; default: gem's cpu engine with the numerics of the case.
//   The
//                 choice matters: floes that touch in gem start inside Box2D's usual skins and are pushed apart
//
// Each setting runs once to be judged (overlap at 20 instants, ice force, end state), then REPETITIONS times to be
// timed. Settings take turns, so that other load of the machine affects all of them. Times are of the process; user
// time depends least on other load. Without warm=1 every setting starts without warm start, as a setting that differs
// from the leader must.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/overlaps.h"
#include "bench/setting.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem_version.h"

namespace gem::bench {
namespace {

constexpr int judged_instants = 20;

struct Setting : EngineSetting {
  explicit Setting(EngineSetting setting) : EngineSetting(std::move(setting)) {}

  Overlaps worst;  // maximum of each member over the instants
  Vec2 mean_force;
  std::vector<double> contacts, iterations, residual;  // of each time step; residual in [m/s]
  std::uint64_t hash = 0;
  Bodies end;
  std::vector<double> user, wall;  // of the timed runs [s]
};

std::vector<double> times_of(const std::string& text) {
  std::vector<double> times;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) times.push_back(number_of(word, "START_S"));
  if (times.empty() || times[0] < 0.0 || !std::is_sorted(times.begin(), times.end()))
    throw Error(ExitCode::usage, "START_S is no ascending list of times (got '" + text + "'); give one");
  return times;
}

/// Advances the leader to `time`.
EngineState state_at(Engine& leader, const SceneDef& scene, double time) {
  StepLog log;
  log.wants_events = false;
  const std::int64_t last = std::llround(time / scene.numerics.time_step_s);
  while (leader.step() < last) {
    log.clear();
    leader.advance(std::min<std::int64_t>(100, last - leader.step()), log);
  }
  return leader.save();
}

/// `timed`: this is the only run, so the engine's time is recorded, without its first time step.
void judge(Setting& setting, const Start& start, double window, bool timed) {
  const auto engine = engine_at(setting, start);
  setting.worst = {};
  setting.user.clear();
  setting.wall.clear();
  for (std::vector<double>* const values : {&setting.contacts, &setting.iterations, &setting.residual}) values->clear();
  const std::int64_t first = engine->step(), steps = steps_in(setting, window);
  Vec2 impulse;
  StepLog log;
  log.wants_events = false;
  Spent spent;
  for (int k = 1; k <= judged_instants; ++k) {
    log.clear();
    if (k == 1) engine->advance(1, log);
    const Spent before = spent_so_far();
    engine->advance(first + steps * k / judged_instants - engine->step(), log);
    spent += spent_so_far() - before;
    for (const PlatformStep& step : log.platform) impulse += step.ice_impulse;
    for (const StepQuality& quality : log.quality) {
      setting.contacts.push_back(quality.contacts);
      setting.iterations.push_back(quality.iterations);
      setting.residual.push_back(quality.residual);
    }
    const Overlaps now = overlaps_of(engine->bodies());
    Overlaps& worst = setting.worst;
    worst.near_pairs = std::max(worst.near_pairs, now.near_pairs);
    worst.overlapping_pairs = std::max(worst.overlapping_pairs, now.overlapping_pairs);
    worst.maximum = std::max(worst.maximum, now.maximum);
    worst.quantile_999 = std::max(worst.quantile_999, now.quantile_999);
    worst.mean = std::max(worst.mean, now.mean);
    worst.mean_gap = std::max(worst.mean_gap, now.mean_gap);
  }
  if (timed) {
    setting.user.push_back(spent.user);
    setting.wall.push_back(spent.wall);
  }
  setting.mean_force = (1.0 / window) * impulse;
  setting.hash = engine->state_hash();
  setting.end = engine->bodies();
}

/// Times a window in which only the engine runs. The first time step builds its lists and is not counted.
void time_once(Setting& setting, const Start& start, double window) {
  const auto engine = engine_at(setting, start);
  StepLog log;
  log.wants_events = false;
  engine->advance(1, log);
  const Spent before = spent_so_far();
  engine->advance(steps_in(setting, window) - 1, log);
  const Spent spent = spent_so_far() - before;
  setting.user.push_back(spent.user);
  setting.wall.push_back(spent.wall);
  if (engine->state_hash() != setting.hash)
    throw Error(ExitCode::numerical_stop, setting.label +
                                              " gave other bits when repeated (its engine is not "
                                              "deterministic, or blocks matter); find out why");
}

void print_row(const std::string& name, double time, double window, const Setting& s, const Setting* reference) {
  const double timed = window - s.scene.numerics.time_step_s;
  std::string row = name + "," + number_text(time) + "," + number_text(window) + "," + s.label + "," + s.engine.name;
  for (const double value : {s.scene.numerics.time_step_s, median(s.user) / timed,
                             s.user.empty() ? std::nan("") : *std::min_element(s.user.begin(), s.user.end()) / timed,
                             median(s.wall) / timed, timed / median(s.user), s.worst.maximum, s.worst.quantile_999,
                             s.worst.mean, s.worst.mean_gap, static_cast<double>(s.worst.near_pairs),
                             static_cast<double>(s.worst.overlapping_pairs), s.mean_force.x, s.mean_force.y})
    row += "," + number_text(value, 6);
  for (const double value : {median(s.contacts), median(s.iterations), median(s.residual)})
    row += "," + number_text(value, 6);
  row += reference == nullptr ? ",,"
                              : "," + number_text(floe_distance(s.end, reference->end).rms, 6) + "," +
                                    number_text(length(s.end.position[0] - reference->end.position[0]), 6);
  std::cout << row << ',' << hex(s.hash) << ',' << GEM_COMMIT << std::endl;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 5) throw Error(ExitCode::usage, "five arguments are needed (see the head of the source)");
  const CaseChoice choice = case_named(arguments[0]);
  const std::vector<double> times = times_of(arguments[1]);
  const double window = number_of(arguments[2], "WINDOW_S");
  const int repetitions = static_cast<int>(number_of(arguments[3], "REPETITIONS"));
  if (!(window > 0.0 && repetitions >= 0))
    throw Error(ExitCode::usage, "a window and no negative number of repetitions are needed (values out of range)");
  std::vector<Setting> settings;
  for (const EngineSetting& setting : read_settings(arguments[4], choice)) settings.emplace_back(setting);

  const auto labelled = [&](std::size_t argument) -> const Setting* {
    if (arguments.size() <= argument || arguments[argument] == "-") return nullptr;
    for (const Setting& setting : settings)
      if (setting.label == arguments[argument]) return &setting;
    throw Error(ExitCode::usage,
                "no setting '" + arguments[argument] + "' in " + arguments[4] + " name one of its labels");
  };
  const Setting* const reference = labelled(5);
  const Setting* const leader = labelled(6);
  const SceneDef scene = with_floes_of_run_file(read_case(choice));
  const SceneDef& lead_scene = leader == nullptr ? scene : leader->scene;
  const auto lead =
      make_engine(lead_scene, make_field(lead_scene), leader == nullptr ? EngineOptions{} : leader->engine);
  std::cout
      << "case,start_s,window_s,setting,engine,moment_s,user_s_per_s,user_least_s_per_s,wall_s_per_s,"
         "real_time_factor,overlap_maximum_m,overlap_999_m,overlap_mean_m,gap_mean_m,near_pairs,"
         "overlapping_pairs,ice_force_x_N,ice_force_y_N,contacts_median,iterations_median,residual_median_m_per_s,"
         "floe_distance_rms_m,platform_distance_m,state_hash,commit\n";
  for (const double time : times) {
    const Start start{state_at(*lead, lead_scene, time), lead_scene.numerics.time_step_s, time};
    for (Setting& setting : settings) judge(setting, start, window, repetitions == 0 && &setting != reference);
    for (int repetition = 0; repetition < repetitions; ++repetition)
      for (std::size_t k = 0; k < settings.size(); ++k) {
        Setting& setting = settings[(k + static_cast<std::size_t>(repetition)) % settings.size()];
        if (&setting != reference) time_once(setting, start, window);
      }
    for (const Setting& setting : settings) print_row(scene.run.name, time, window, setting, reference);
  }
  return 0;
}

}  // namespace
}  // namespace gem::bench

int main(int argc, char** argv) { return gem::bench::run_program("speed_against_error", gem::bench::run, argc, argv); }
