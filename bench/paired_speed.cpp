// Real-time factor of several engines on one case, measured in pairs. All engines run the same case in one process and
// take turns, one block of simulated time each, so that other load of the machine affects them equally. One row per
// block and engine.
//
// Usage: paired_speed CASE SETTINGS BLOCKS UNTIL_S OUT.csv [NAME [KEY=VALUE...]]
//   CASE      case file; a member of a sweep as FILE#INDEX
//   SETTINGS  see bench/setting.h
//   BLOCKS    number of blocks of equal simulated time, whole time steps each
//   UNTIL_S   end of the run; 0: the duration of the case
//   NAME      name for the rows instead of the case's own; KEY=VALUE change the case for all settings
// Times are of the engines alone; nothing is recorded. Every engine starts from the field at t = 0 and follows its own
// path.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "bench/setting.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/field/field.h"
#include "gem_version.h"

namespace gem::bench {
namespace {

struct Runner {
  EngineSetting setting;
  std::unique_ptr<Engine> engine;
};

std::vector<Runner> runners(const std::string& settings, const CaseChoice& choice) {
  std::vector<Runner> all;
  for (const EngineSetting& setting : read_settings(settings, choice))
    all.push_back({setting, make_engine(setting.scene, make_field(setting.scene), setting.engine)});
  return all;
}

std::int64_t floes_of(Engine& engine) {
  const auto& kind = engine.bodies().kind;
  return std::count(kind.begin(), kind.end(), BodyKind::floe);
}

struct Block {
  Spent spent;
  double contacts = 0.0;  // mean over its time steps; 0 if the engine does not count contacts
};

Block advanced(Runner& runner, double until) {
  StepLog log;
  log.wants_events = false;
  const std::int64_t steps = steps_in(runner.setting, until) - runner.engine->step();
  const Spent before = spent_so_far();
  runner.engine->advance(steps, log);
  Block block{spent_so_far() - before, 0.0};
  for (const StepQuality& quality : log.quality) block.contacts += quality.contacts / static_cast<double>(steps);
  return block;
}

int run(const std::vector<std::string>& a) {
  if (a.size() < 5) throw Error(ExitCode::usage, "five arguments are needed (see the head of the source)");
  CaseChoice choice = case_named(a[0]);
  for (std::size_t k = 6; k < a.size(); ++k) choice.overrides.push_back(a[k]);
  const int blocks = static_cast<int>(number_of(a[2], "BLOCKS"));
  const SceneDef scene = read_case(choice);
  const double asked = number_of(a[3], "UNTIL_S"), until = asked > 0.0 ? asked : scene.run.duration_s;
  if (blocks < 1) throw Error(ExitCode::usage, "BLOCKS is " + a[2] + " (at least 1 is needed); give more");
  std::ofstream out(a[4]);
  if (!out) throw Error(ExitCode::file_system, "cannot write " + a[4] + " (it does not open); name another file");
  out << "case,setting,engine,threads,floes,moment_s,block,from_s,to_s,user_s,wall_s,contacts,commit\n";
  std::vector<Runner> all = runners(a[1], choice);
  const std::string name = a.size() > 5 ? a[5] : scene.run.name;
  // Every block ends at a multiple of every setting's time step.
  double longest = 0.0;
  for (const Runner& runner : all) longest = std::max(longest, runner.setting.scene.numerics.time_step_s);
  const auto end_of = [&](int block) { return longest * std::floor(until * block / blocks / longest + 1e-9); };
  for (int b = 0; b < blocks; ++b)
    for (std::size_t k = 0; k < all.size(); ++k) {
      Runner& runner = all[(k + static_cast<std::size_t>(b)) % all.size()];
      const Block block = advanced(runner, end_of(b + 1));
      out << name << ',' << runner.setting.label << ',' << runner.setting.engine.name << ','
          << runner.setting.engine.threads << ',' << floes_of(*runner.engine) << ','
          << number_text(runner.setting.scene.numerics.time_step_s) << ',' << b << ',' << number_text(end_of(b), 6)
          << ',' << number_text(end_of(b + 1), 6) << ',' << number_text(block.spent.user, 6) << ','
          << number_text(block.spent.wall, 6) << ',' << number_text(block.contacts, 6) << ',' << GEM_COMMIT
          << std::endl;
    }
  return 0;
}

}  // namespace
}  // namespace gem::bench

int main(int argc, char** argv) { return gem::bench::run_program("paired_speed", gem::bench::run, argc, argv); }
