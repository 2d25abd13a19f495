// Speed and error of engines and settings, side by side: every setting starts from the same state of one case, runs the
// same window, and is judged outside the engine. Prints CSV.
//
// Usage: speed_against_error CASE START_S WINDOW_S REPETITIONS SETTINGS [REFERENCE [LEADER]]
//   CASE          case file; a member of a sweep as FILE#INDEX
//   START_S       when the window begins
//   SETTINGS      file, one setting a line: label | engine | options | scene overrides
//                 options: threads= velocity_iterations= position_iterations= skin=
//   REFERENCE     label of the setting whose end positions the others are compared with; it is not timed; - for none
//   LEADER        label of the setting that leads to START_S; without one gem's cpu engine does, with the case's own
//                 numerics. It matters: floes that gem left touching begin inside Box2D's usual skins, and are pushed
//                 apart in the window
//
// Each setting runs once to be judged (overlap at 20 instants, ice force, end state), then REPETITIONS times for its
// time, settings taking turns so that a busy machine is busy for all. Times are of the process: user time is what the
// other load of a machine changes least. All begin without warm start, which is what a changed setting has.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "baseline_box2d/register_box2d.h"
#include "bench/overlaps.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/engine/engine.h"
#include "gem_version.h"

namespace gem::bench {
namespace {

constexpr int judged_instants = 20;

double number_of(const std::string& text, const std::string& what) {
  const auto value = parse_number(text);
  if (!value) throw Error(ExitCode::usage, what + " is no number ('" + text + "') give one");
  return *value;
}

struct Setting {
  std::string label;
  EngineOptions engine;
  std::vector<std::string> overrides;
  SceneDef scene;

  // judged
  Overlaps worst;  // each member its largest over the instants
  Vec2 mean_force;
  std::uint64_t hash = 0;
  Bodies end;
  // timed
  std::vector<double> user, wall;  // [s]
};

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> found;
  for (std::string word; stream >> word;) found.push_back(word);
  return found;
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

void set_option(EngineOptions& options, const std::string& option) {
  const std::string key = option.substr(0, option.find('='));
  const double value = number_of(option.substr(option.find('=') + 1), key);
  if (key == "threads") {
    options.threads = static_cast<int>(value);
  } else if (key == "velocity_iterations") {
    options.baseline.velocity_iterations = static_cast<int>(value);
  } else if (key == "position_iterations") {
    options.baseline.position_iterations = static_cast<int>(value);
  } else if (key == "skin") {
    options.baseline.skin_m = value;
  } else {
    throw Error(ExitCode::usage, "unknown option '" + key + "' (see the head of bench/speed_against_error.cpp)");
  }
}

CaseChoice case_named(const std::string& text) {
  CaseChoice choice;
  choice.path = text.substr(0, text.find('#'));
  if (text.find('#') != std::string::npos)
    choice.index = static_cast<long long>(number_of(text.substr(text.find('#') + 1), "the case's index"));
  return choice;
}

std::vector<Setting> read_settings(const std::string& path, const CaseChoice& chosen_case) {
  std::ifstream file(path);
  if (!file) throw Error(ExitCode::file_system, "cannot read " + path + " (it does not open) name a settings file");
  std::vector<Setting> settings;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream stream(line);
    std::string label, engine, options, overrides;
    std::getline(stream, label, '|');
    std::getline(stream, engine, '|');
    std::getline(stream, options, '|');
    std::getline(stream, overrides, '|');
    Setting setting;
    setting.label = trimmed(label);
    setting.engine.name = trimmed(engine);
    setting.engine.threads = 1;
    setting.engine.baseline.measures_quality = false;  // judged outside
    for (const std::string& option : words(options)) set_option(setting.engine, option);
    CaseChoice choice = chosen_case;
    choice.overrides = words(overrides);
    setting.overrides = choice.overrides;
    setting.scene = read_case(choice);
    settings.push_back(setting);
  }
  return settings;
}

/// State of the case at `time`, without the impulses of its last moment.
EngineState state_at(const SceneDef& scene, const EngineOptions& options, double time) {
  const auto engine = make_engine(scene, field_of(scene), options);
  MomentLog log;
  log.wants_events = false;
  const std::int64_t last = std::llround(time / scene.numerics.moment_s);
  while (engine->moment() < last) {
    log.clear();
    engine->advance(std::min<std::int64_t>(100, last - engine->moment()), log);
  }
  EngineState state = engine->save();
  state.impulse_key.clear();
  state.impulse_value.clear();
  return state;
}

std::unique_ptr<Engine> engine_at(const Setting& setting, EngineState state, double time) {
  auto engine = make_engine(setting.scene, state.bodies, setting.engine);
  state.moment = std::llround(time / setting.scene.numerics.moment_s);
  engine->restore(state);
  return engine;
}

std::int64_t moments_in(const Setting& setting, double window) {
  return std::llround(window / setting.scene.numerics.moment_s);
}

void judge(Setting& setting, const EngineState& state, double time, double window) {
  const auto engine = engine_at(setting, state, time);
  const std::int64_t first = engine->moment(), moments = moments_in(setting, window);
  Vec2 impulse;
  MomentLog log;
  log.wants_events = false;
  for (int k = 1; k <= judged_instants; ++k) {
    log.clear();
    engine->advance(first + moments * k / judged_instants - engine->moment(), log);
    for (const PlatformMoment& moment : log.platform) impulse += moment.ice_impulse;
    const Overlaps now = overlaps_of(engine->bodies());
    Overlaps& worst = setting.worst;
    worst.near_pairs = std::max(worst.near_pairs, now.near_pairs);
    worst.overlapping_pairs = std::max(worst.overlapping_pairs, now.overlapping_pairs);
    worst.maximum = std::max(worst.maximum, now.maximum);
    worst.quantile_999 = std::max(worst.quantile_999, now.quantile_999);
    worst.mean = std::max(worst.mean, now.mean);
    worst.mean_gap = std::max(worst.mean_gap, now.mean_gap);
  }
  setting.mean_force = (1.0 / window) * impulse;
  setting.hash = engine->state_hash();
  setting.end = engine->bodies();
}

double user_time() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// Times a window in which nothing but the engine runs; the first moment builds its lists and is not counted.
void time_once(Setting& setting, const EngineState& state, double time, double window) {
  const auto engine = engine_at(setting, state, time);
  MomentLog log;
  log.wants_events = false;
  engine->advance(1, log);
  const double user = user_time();
  const auto start = std::chrono::steady_clock::now();
  engine->advance(moments_in(setting, window) - 1, log);
  setting.user.push_back(user_time() - user);
  setting.wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  if (engine->state_hash() != setting.hash)
    throw Error(ExitCode::numerical_stop, setting.label +
                                              " gave other bits when repeated (its engine is not "
                                              "deterministic, or blocks matter) find out why");
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// Root of the mean square distance of floes that both still have [m].
double floe_distance(const Bodies& a, const Bodies& b) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < a.count(); ++i) {
    if (a.kind[i] != BodyKind::floe || !a.active[i] || !b.active[i]) continue;
    sum += dot(a.position[i] - b.position[i], a.position[i] - b.position[i]);
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

std::string hex(std::uint64_t value) {
  std::ostringstream text;
  text << std::hex << value;
  return text.str();
}

void print_row(const std::string& name, double time, double window, const Setting& s, const Setting* reference) {
  const double timed = window - s.scene.numerics.moment_s;
  std::string row = name + "," + number_text(time) + "," + number_text(window) + "," + s.label + "," + s.engine.name;
  for (const double value : {s.scene.numerics.moment_s, median(s.user) / timed,
                             s.user.empty() ? std::nan("") : *std::min_element(s.user.begin(), s.user.end()) / timed,
                             median(s.wall) / timed, timed / median(s.user), s.worst.maximum, s.worst.quantile_999,
                             s.worst.mean, s.worst.mean_gap, static_cast<double>(s.worst.near_pairs),
                             static_cast<double>(s.worst.overlapping_pairs), s.mean_force.x, s.mean_force.y})
    row += "," + number_text(value, 6);
  row += reference == nullptr ? ",,"
                              : "," + number_text(floe_distance(s.end, reference->end), 6) + "," +
                                    number_text(length(s.end.position[0] - reference->end.position[0]), 6);
  std::cout << row << ',' << hex(s.hash) << ',' << GEM_COMMIT << std::endl;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 5) throw Error(ExitCode::usage, "five arguments are needed (see the head of the source)");
  const CaseChoice choice = case_named(arguments[0]);
  const double time = number_of(arguments[1], "START_S"), window = number_of(arguments[2], "WINDOW_S");
  const int repetitions = static_cast<int>(number_of(arguments[3], "REPETITIONS"));
  if (!(time >= 0.0 && window > 0.0 && repetitions >= 1))
    throw Error(ExitCode::usage, "a start, a window and at least one repetition are needed (values out of range)");
  std::vector<Setting> settings = read_settings(arguments[4], choice);

  const auto labelled = [&](std::size_t argument) -> const Setting* {
    if (arguments.size() <= argument || arguments[argument] == "-") return nullptr;
    for (const Setting& setting : settings)
      if (setting.label == arguments[argument]) return &setting;
    throw Error(ExitCode::usage,
                "no setting '" + arguments[argument] + "' in " + arguments[4] + " name one of its labels");
  };
  const Setting* const reference = labelled(5);
  const Setting* const leader = labelled(6);
  const SceneDef scene = read_case(choice);
  const EngineState state =
      leader == nullptr ? state_at(scene, {}, time) : state_at(leader->scene, leader->engine, time);
  for (Setting& setting : settings) judge(setting, state, time, window);
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t k = 0; k < settings.size(); ++k) {
      Setting& setting = settings[(k + static_cast<std::size_t>(repetition)) % settings.size()];
      if (&setting != reference) time_once(setting, state, time, window);
    }

  std::cout
      << "case,start_s,window_s,setting,engine,moment_s,user_s_per_s,user_least_s_per_s,wall_s_per_s,"
         "real_time_factor,overlap_maximum_m,overlap_999_m,overlap_mean_m,gap_mean_m,near_pairs,"
         "overlapping_pairs,ice_force_x_N,ice_force_y_N,floe_distance_rms_m,platform_distance_m,state_hash,commit\n";
  for (const Setting& setting : settings) print_row(scene.run.name, time, window, setting, reference);
  return 0;
}

}  // namespace
}  // namespace gem::bench

int main(int argc, char** argv) {
  gem::baseline::register_box2d();
  try {
    return gem::bench::run({argv + 1, argv + argc});
  } catch (const gem::Error& error) {
    std::cerr << "speed_against_error: " << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
