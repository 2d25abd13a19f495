#include "bench/setting.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>

#include "baseline_box2d/box2d_options.h"
#include "baseline_box2d/register_box2d.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"

namespace gem::bench {
namespace {

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

void set_option(EngineSetting& setting, const std::string& option) {
  EngineOptions& options = setting.engine;
  const std::string key = option.substr(0, option.find('='));
  const std::string text = option.substr(option.find('=') + 1);
  const double value = number_of(text, key);
  if (key == "threads") {
    options.threads = static_cast<int>(value);
  } else if (key == "warm") {
    setting.warm = value != 0.0;
  } else if (key == "step_factor") {
    if (!(value > 0.0)) throw Error(ExitCode::usage, option + " is no factor (it must be above 0); correct it");
    setting.step_factor = value;
  } else {
    options.baseline_settings.push_back(key == "skin" ? "skin_m=" + text : option);
    baseline::box2d_options(options.baseline_settings);  // rejects unknown settings
  }
}

/// Scales the impulses to a time step of another length, so that the forces stay. The repair starts again from zero.
void scale_impulses(EngineState& state, double ratio) {
  for (PointMemory& point : state.impulse_value)
    point = {{ratio * point.impulse.normal, ratio * point.impulse.tangential, 0.0}, ratio * point.rise};
}

}  // namespace

double number_of(const std::string& text, const std::string& what) {
  const auto value = parse_number(text);
  if (!value) throw Error(ExitCode::usage, what + " is no number ('" + text + "'); give one");
  return *value;
}

CaseChoice case_named(const std::string& text) {
  CaseChoice choice;
  choice.path = text.substr(0, text.find('#'));
  if (text.find('#') != std::string::npos)
    choice.index = static_cast<long long>(number_of(text.substr(text.find('#') + 1), "the case's index"));
  return choice;
}

std::vector<EngineSetting> read_settings(const std::string& path, const CaseChoice& chosen_case) {
  std::ifstream file(path);
  if (!file) throw Error(ExitCode::file_system, "cannot read " + path + " (it does not open); name a settings file");
  std::vector<EngineSetting> settings;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream stream(line);
    std::string label, engine, options, overrides;
    std::getline(stream, label, '|');
    std::getline(stream, engine, '|');
    std::getline(stream, options, '|');
    std::getline(stream, overrides, '|');
    EngineSetting setting;
    setting.label = trimmed(label);
    setting.engine.name = trimmed(engine);
    setting.engine.threads = 1;
    setting.engine.baseline_settings = {"measures_quality=0"};  // measured outside the engine
    for (const std::string& option : words(options)) set_option(setting, option);
    CaseChoice choice = chosen_case;
    choice.overrides.insert(choice.overrides.begin(),
                            "contact.solver=\"coupled\"");  // unless the setting says otherwise
    setting.overrides = words(overrides);
    choice.overrides.insert(choice.overrides.end(), setting.overrides.begin(), setting.overrides.end());
    setting.scene = with_floes_of_run_file(read_case(choice));
    setting.scene.numerics.time_step_s *= setting.step_factor;
    settings.push_back(setting);
  }
  return settings;
}

std::unique_ptr<Engine> engine_at(const EngineSetting& setting, const Start& start) {
  EngineState state = start.state;
  if (setting.warm) {
    scale_impulses(state, setting.scene.numerics.time_step_s / start.time_step_s);
  } else {
    state.impulse_key.clear();
    state.impulse_value.clear();
  }
  const double time = start.time;
  auto engine = make_engine(setting.scene, state.bodies, setting.engine);
  state.step = std::llround(time / setting.scene.numerics.time_step_s);
  engine->restore(state);
  return engine;
}

std::int64_t steps_in(const EngineSetting& setting, double seconds) {
  return std::llround(seconds / setting.scene.numerics.time_step_s);
}

Spent spent_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double user = static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
  return {user, std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count()};
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

FloeDistance floe_distance(const Bodies& a, const Bodies& b) {
  FloeDistance found;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.count(); ++i) {
    if (a.kind[i] != BodyKind::floe || !a.active[i] || !b.active[i]) continue;
    const double square = dot(a.position[i] - b.position[i], a.position[i] - b.position[i]);
    sum += square;
    found.largest = std::max(found.largest, std::sqrt(square));
    found.count += 1.0;
  }
  if (found.count > 0.0) found.rms = std::sqrt(sum / found.count);
  return found;
}

std::string hex(std::uint64_t value) {
  std::ostringstream text;
  text << std::hex << value;
  return text.str();
}

int run_program(const char* name, int (*run)(const std::vector<std::string>&), int argc, char** argv) {
  baseline::register_box2d();
  try {
    return run({argv + 1, argv + argc});
  } catch (const Error& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}

}  // namespace gem::bench
