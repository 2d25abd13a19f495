// Candidates on frozen time steps: a run is stopped, its next contact problem taken out, and every method iterates on
// it from nothing and from the last time step's impulses. Prints CSV.
//
// Usage: frozen_study LABEL CASE T1,T2,...     (CASE: FILE, or FILE#NAME of a sweep; times in s, ascending)
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "bench/solver_study/method.h"
#include "bench/solver_study/scenes.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/engine/cpu/pair_list.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/solo_stages.h"
#include "gem/field/field.h"
#include "gem_version.h"

namespace gem::bench {
namespace {

const std::set<int> looked_at = {0, 1, 2, 5, 12, 24, 48, 96, 192};

/// The time step after a state, up to its events.
struct Frozen {
  FieldState field;
  PairList pairs;
  ThreadTeam team{1};

  Frozen(const SceneDef& scene, const EngineState& state)
      : field(make_field_state(state.bodies, step_constants(scene, state.bodies))) {
    team.run([&](int rank) { pairs.find(field, team, rank); });
    for (std::size_t i = 0; i < field.bodies.count(); ++i)
      if (field.bodies.kind[i] == BodyKind::floe) kick_floe(field, i);
    platform_first_half(field);
    for (Contact* contact : pairs.contacts()) prepare_contact(field, *contact);
  }
};

void follow(const std::string& problem_name, const std::string& start_name, const Problem& problem,
            const Impulses& start, const Candidate& candidate) {
  std::unique_ptr<Method> method;
  try {
    method = candidate.make(problem, start);
  } catch (const std::invalid_argument&) {
    return;  // not made for this problem
  }
  for (int pass = 0; pass <= *looked_at.rbegin(); ++pass) {
    if (pass > 0) method->pass();
    if (!looked_at.contains(pass)) continue;
    const Score score = score_of(problem, method->impulses());
    std::cout << problem_name << ',' << problem.points() << ',' << start_name << ',' << candidate.name << ',' << pass
              << ',' << pass * static_cast<std::int64_t>(problem.points()) << ',' << pass * method->phases_per_pass()
              << ',' << number_text(score.largest, 6) << ',' << number_text(score.rms, 6) << ','
              << number_text(score.largest_repair, 6) << ',' << GEM_COMMIT << '\n';
  }
}

void study(const std::string& label, const SceneDef& scene, const EngineState& state, double time) {
  Frozen frozen(scene, state);
  WarmStart last;
  for (std::size_t i = 0; i < state.impulse_key.size(); ++i) last[state.impulse_key[i]] = state.impulse_value[i];
  const Contacts contacts = frozen.pairs.contacts();
  Impulses warm = warm_impulses(contacts, last, repair_memory);
  const Problem problem = make_problem(frozen.field, contacts, warm);
  keep_best_share(problem, warm, 1.0);
  const Impulses cold(problem.points(), PointImpulse<double>{});
  std::vector<Candidate> all = candidates();
  all.push_back(chain_elimination());
  const std::string name = label + " " + number_text(time, 6) + " s";
  for (const Candidate& candidate : all) {
    follow(name, "cold", problem, cold, candidate);
    follow(name, "warm", problem, warm, candidate);
  }
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 3) throw Error(ExitCode::usage, "LABEL CASE TIMES are needed (see the head of the source)");
  const SceneDef scene = scene_named(arguments[1]);
  const auto leader = make_engine(scene, make_field(scene), {.name = "cpu", .threads = 1});
  std::cout << "problem,points,start,method,pass,visits,phases,largest_m_per_s,rms_m_per_s,largest_repair_m,commit\n";
  std::istringstream times(arguments[2]);
  for (std::string word; std::getline(times, word, ',');) {
    const auto time = parse_number(word);
    if (!time) throw Error(ExitCode::usage, "'" + word + "' is no time (a number is needed) give one");
    study(arguments[0], scene, state_at(*leader, scene.numerics.time_step_s, *time), *time);
  }
  return 0;
}

}  // namespace
}  // namespace gem::bench

int main(int argc, char** argv) {
  try {
    return gem::bench::run({argv + 1, argv + argc});
  } catch (const gem::Error& error) {
    std::cerr << "frozen_study: " << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
