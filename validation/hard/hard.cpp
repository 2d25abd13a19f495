// Reads, runs and judges the hard cases.
#include "validation/hard/hard.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

#include "gem/base/error.h"
#include "gem/field/check_field.h"
#include "gem/field/field.h"
#include "gem/scene/sweep/sweep.h"
#include "gem/scene/toml/scene_file.h"

namespace gem::hard {
namespace {

std::string path_of(const std::string& file) { return std::string(GEM_SOURCE_DIR) + "/cases/hard/" + file; }

/// The lines of known_misses.txt: `solver key | why`.
std::set<std::string> read_misses() {
  std::ifstream file(std::string(GEM_SOURCE_DIR) + "/validation/hard/known_misses.txt");
  if (!file) throw std::runtime_error("known_misses.txt cannot be read");
  std::set<std::string> keys;
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line[0] != '#') keys.insert(line.substr(0, line.find(" |")));
  return keys;
}

/// Impulse that went through the channels between two states of the books [N s]. Impulses between floes cancel and are
/// not seen.
double exchanged_between(const Ledger& before, const Ledger& after) {
  double sum = length(after.mooring_force.momentum - before.mooring_force.momentum);
  for (std::size_t c = 0; c < before.channel.size(); ++c)
    sum += length(after.channel[c].momentum - before.channel[c].momentum);
  return sum;
}

double farthest_place(const Bodies& b) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < b.count(); ++i)
    if (b.active[i] && b.kind[i] != BodyKind::fixed) farthest = std::max(farthest, length(b.position[i]) + b.radius[i]);
  return farthest;
}

double share(double part, double whole) { return whole > 0.0 ? part / whole : part; }

}  // namespace

std::vector<Setting> large_settings() {
  std::vector<Setting> settings = verification::all_settings();
  std::erase_if(settings, [](const Setting& s) { return s.engine == "reference"; });
  return settings;
}

SceneDef resolved_as(SceneDef scene, const Setting& setting) {
  setting.apply_to(scene);
  scene.contact.manifold = setting.coupled() ? Manifold::chord_ends : Manifold::chord_middle;
  return scene;
}

SceneDef read_hard_case(const std::string& file, const Setting& setting, const std::vector<std::string>& overrides) {
  return resolved_as(read_scene(path_of(file), overrides), setting);
}

SceneDef read_hard_member(const std::string& file, const std::string& name, const Setting& setting,
                          const std::vector<std::string>& overrides) {
  for (const SweepMember& member : expand_sweep(path_of(file), overrides))
    if (member.name == name) return resolved_as(member.scene, setting);
  throw std::runtime_error(file + " has no run " + name);
}

SceneDef with_default_numerics(SceneDef scene) {
  const IterationEnd end = default_end(scene.numerics.iteration);
  scene.numerics.iterations_maximum = end.iterations_maximum;
  scene.numerics.residual_tolerance = end.residual_tolerance;
  return scene;
}

bool is_refused(const std::string& file, const std::vector<std::string>& overrides, const std::string& what) {
  try {
    const std::string path = path_of(file);
    make_field(is_sweep(path) ? expand_sweep(path, overrides).at(0).scene : read_scene(path, overrides));
  } catch (const Error& error) {
    const bool names_it = std::string(error.what()).find(what) != std::string::npos;
    EXPECT_TRUE(names_it) << "refused, but for another reason: " << error.what();
    return names_it && error.code() == ExitCode::scene_rejected;
  }
  return false;
}

Watched::Watched(const SceneDef& scene, const Setting& setting) : Watched(scene, make_field(scene), setting) {}

Watched::Watched(const SceneDef& scene, Bodies bodies, const Setting& setting, int threads)
    : setting_(setting), engine_(make_engine(scene, std::move(bodies), {setting.engine, threads})) {
  log_.wants_events = false;
  last_ = engine_->ledger();
}

void Watched::advance(std::int64_t steps, std::int64_t block) {
  advance(steps, block, [] {});
}

void Watched::one_block(std::int64_t steps) {
  log_.clear();
  engine_->advance(steps, log_);
  for (const StepQuality& quality : log_.quality) {
    worst_.contacts += quality.contacts;
    worst_.iterations = std::max(worst_.iterations, quality.iterations);
    worst_.overlap = std::max(worst_.overlap, quality.maximum_overlap);
  }
  const Ledger ledger = engine_->ledger();
  const double energy = hard::contact_energy(ledger);
  worst_.created += std::max(0.0, energy - contact_energy_);
  contact_energy_ = energy;
  worst_.exchanged += exchanged_between(last_, ledger);
  last_ = ledger;
  const LedgerResidual left = residual(ledger);
  const double momentum = std::max(ledger.momentum_scale, worst_.exchanged);
  const double angular = std::max(ledger.angular_scale, worst_.exchanged * farthest_place(engine_->bodies()));
  worst_.momentum = std::max(worst_.momentum, share(left.momentum * ledger.momentum_scale, momentum));
  worst_.angular_momentum =
      std::max(worst_.angular_momentum, share(left.angular_momentum * ledger.angular_scale, angular));
  worst_.energy = std::max(worst_.energy, left.energy);
}

void bound(const std::string& key, double computed, double limit, const std::string& unit, const Where& where) {
  static const std::set<std::string> misses = read_misses();
  EXPECT_GE(computed, 0.0) << key;
  const std::string name = where.solver + " " + key;
  if (misses.contains(name) && !misses.contains("met " + where.engine + " " + name)) {
    verification::check_missed(key, limit, computed, unit, where);
  } else {
    verification::check_value(key, 0.0, computed, limit, unit, where);
  }
}

void expect_sound(const std::string& id, Watched& run) {
  const Worst& worst = run.worst();
  EXPECT_GT(worst.contacts, 0) << id << ": the bodies never touched";
  // Relative to what run_scene allows. Equal terms in each time step may all be rounded in the same direction.
  const double allowed = std::max(1e-11, 0x1p-53 * static_cast<double>(run.engine().step()));
  const double books = std::max({worst.momentum / allowed, worst.angular_momentum / allowed, worst.energy / 1e-8});
  bound(id + ".books", books, 1.0, "-", run.where());
  // Must be zero; the limit is the rounding of the sum of all energies.
  bound(id + ".created", share(worst.created, run.ledger().energy_scale), 1e-9, "-", run.where());
}

double held_push(const SceneDef& scene, const Bodies& bodies) {
  const double speed = length(scene.current.velocity_m_per_s);
  double push = 0.0;
  for (std::size_t i = first_floe_of(bodies); i < bodies.count(); ++i) {
    if (!bodies.active[i]) continue;
    const double share = bodies.drag[i] * speed * scene.numerics.time_step_s;
    push += bodies.mass[i] * bodies.drag[i] * speed * speed / (1.0 + share);
  }
  return push;
}

Vec2 given_by_fixed(const Ledger& ledger) {
  return ledger[Channel::impact].momentum + ledger[Channel::friction].momentum + ledger[Channel::elastic].momentum;
}

double contact_energy(const Ledger& ledger) {
  return ledger[Channel::impact].energy + ledger[Channel::friction].energy + ledger[Channel::elastic].energy +
         ledger[Channel::repair].energy;
}

Overlaps overlaps(const Bodies& bodies) {
  Overlaps found;
  std::vector<double> depths;
  for (const NearPair& pair : near_pairs(bodies, 0.0)) {
    if (!bodies.active[pair.a] || !bodies.active[pair.b]) continue;
    const double depth = std::max(0.0, -pair.separation);
    depths.push_back(depth);
    found.total += depth;
    for (const std::size_t i : {pair.a, pair.b})
      if (bodies.kind[i] == BodyKind::floe)
        found.size_share = std::max(found.size_share, depth / std::sqrt(bodies.area[i]));
  }
  if (depths.empty()) return found;
  std::sort(depths.begin(), depths.end());
  found.deepest = depths.back();
  found.most = depths[static_cast<std::size_t>(0.999 * static_cast<double>(depths.size() - 1))];
  return found;
}

std::size_t points_of(Watched& run) {
  return run.setting().coupled() ? run.engine().save().impulse_key.size()
                                 : static_cast<std::size_t>(run.contacts_now());
}

double fastest_floe(const Bodies& bodies) {
  double fastest = 0.0;
  for (std::size_t i = first_floe_of(bodies); i < bodies.count(); ++i)
    if (bodies.active[i]) fastest = std::max(fastest, length(bodies.velocity[i]));
  return fastest;
}

std::size_t first_floe_of(const Bodies& bodies) {
  return static_cast<std::size_t>(std::find(bodies.kind.begin(), bodies.kind.end(), BodyKind::floe) -
                                  bodies.kind.begin());
}

}  // namespace gem::hard
