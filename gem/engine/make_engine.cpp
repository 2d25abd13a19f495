// Makes engines by name.
#include <algorithm>
#include <thread>
#include <utility>

#include "gem/base/error.h"
#include "gem/base/hash.h"
#include "gem/engine/breakup/breakup_engine.h"
#include "gem/engine/cpu/cpu_engine.h"
#include "gem/engine/cuda/cuda_engine.h"
#include "gem/engine/engine.h"
#include "gem/engine/reference/reference_engine.h"

namespace gem {

namespace {

struct Baseline {
  std::string name;
  BaselineMaker make;
  std::vector<BaselineSetting> settings;
};

std::vector<Baseline>& baselines() {
  static std::vector<Baseline> known;
  return known;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
  return text;
}

}  // namespace

void check_solver(ContactSolver solver, std::initializer_list<ContactSolver> known, const std::string& engine) {
  if (std::find(known.begin(), known.end(), solver) != known.end()) return;
  throw Error(ExitCode::usage, "the engine " + engine + " cannot run contact.solver = \"" + solver_name(solver) +
                                   "\" (it does not have this solver); choose another solver or engine");
}

void check_one_piece(const Bodies& bodies, const std::string& engine) {
  if (platform_bodies(bodies) == 1) return;
  throw Error(ExitCode::usage, "the engine " + engine +
                                   " cannot run a platform of several pieces (platform.outline = \"pieces\"; it knows "
                                   "one convex outline); use --engine cpu");
}

std::vector<std::string> engine_names() { return {"reference", "cpu"}; }

void refuse_breakup(const std::string& engine) {
  throw Error(ExitCode::usage, "the engine " + engine +
                                   " cannot split floes (breakup.maximum_pieces; it keeps the forces between bodies to "
                                   "itself); use --engine cpu, or leave the key out");
}

namespace {

std::unique_ptr<Engine> make_named_engine(const SceneDef& scene, Bodies bodies, const EngineOptions& options) {
  const int machine = std::max(1u, std::thread::hardware_concurrency());
  const int threads = options.threads > 0 ? options.threads : machine;
  if (options.name == "reference") return std::make_unique<ReferenceEngine>(scene, std::move(bodies));
  if (options.name == "cpu")
    return std::make_unique<CpuEngine>(scene, std::move(bodies), threads, options.contacts_worth_a_thread);
  if (options.name == "cuda") return make_cuda_engine(scene, std::move(bodies), {.device = options.device});
  for (const Baseline& baseline : baselines())
    if (options.name == baseline.name) return baseline.make(scene, std::move(bodies), options);
  std::vector<std::string> known = engine_names();
  known.push_back("cuda");
  for (const std::string& name : baseline_names()) known.push_back(name);
  throw Error(ExitCode::usage, "unknown engine '" + options.name + "' (" + joined(known) + ")");
}

}  // namespace

std::unique_ptr<Engine> make_engine(const SceneDef& scene, Bodies bodies, const EngineOptions& options) {
  auto engine = make_named_engine(scene, std::move(bodies), options);
  if (scene.breakup.maximum_pieces == 0) return engine;
  return std::make_unique<BreakupEngine>(scene, std::move(engine));
}

void register_baseline(const std::string& name, BaselineMaker make, std::vector<BaselineSetting> settings) {
  baselines().push_back({name, std::move(make), std::move(settings)});
}

std::vector<std::string> baseline_names() {
  std::vector<std::string> names;
  for (const Baseline& baseline : baselines()) names.push_back(baseline.name);
  return names;
}

std::vector<BaselineSetting> baseline_settings() {
  std::vector<BaselineSetting> settings;
  for (const Baseline& baseline : baselines())
    settings.insert(settings.end(), baseline.settings.begin(), baseline.settings.end());
  return settings;
}

bool is_baseline(const std::string& engine) {
  for (const Baseline& baseline : baselines())
    if (baseline.name == engine) return true;
  return false;
}

std::uint64_t Engine::state_hash() { return hash_of(step(), bodies(), broken_lines(), dp_state(), kept_corners()); }

namespace {

/// What the next time step reads of the state.
void add_dp(Hash& hash, const DpState& dp) {
  hash.add(static_cast<std::uint64_t>(dp.steps));
  for (const double value : {dp.offset.x, dp.offset.y, dp.velocity.x, dp.velocity.y, dp.yaw, dp.spin, dp.integral.x,
                             dp.integral.y, dp.yaw_integral})
    hash.add(value);
  for (const Vec2& thrust : dp.thrust) hash.add(thrust.x), hash.add(thrust.y);
}

void add_corners(Hash& hash, const KeptCorners& corners) {
  for (std::size_t k = 0; k < corners.key.size(); ++k) {
    hash.add(corners.key[k]);
    const CornerMemory& m = corners.value[k];
    for (const double value : {m.crushed, m.stretch, m.stiffness, m.elastic, m.normal, m.side}) hash.add(value);
    hash.add(static_cast<std::uint64_t>(m.pressed_side));
  }
}

}  // namespace

std::uint64_t hash_of(std::int64_t step, const Bodies& b, LineSet broken, const DpState* dp,
                      const KeptCorners& corners) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(step));
  for (std::size_t i = 0; i < b.count(); ++i) {
    for (const double value : {b.position[i].x, b.position[i].y, b.rotation[i].cosine, b.rotation[i].sine,
                               b.velocity[i].x, b.velocity[i].y, b.spin[i]})
      hash.add(value);
    hash.add(static_cast<std::uint64_t>(b.active[i]));
  }
  if (broken != 0) hash.add(broken);
  if (dp) add_dp(hash, *dp);
  add_corners(hash, corners);
  return hash.value();
}

}  // namespace gem
