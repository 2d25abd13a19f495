// Runs of the hard cases: read from cases/hard, observed after every block of time steps, and judged by bounds.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "validation/verification/scenes.h"

namespace gem::hard {

using verification::Setting;
using verification::Where;

/// All engines except the reference engine, with both solvers: for scenes in which all pairs take too long.
std::vector<Setting> large_settings();

/// A case of cases/hard for a setting; independent gets the paper's contacts (chord middle, elastic stress).
SceneDef read_hard_case(const std::string& file, const Setting& setting,
                        const std::vector<std::string>& overrides = {});

/// The run with a name in a case that is a sweep.
SceneDef read_hard_member(const std::string& file, const std::string& name, const Setting& setting,
                          const std::vector<std::string>& overrides = {});

/// Sets the solver and its contacts in a scene made by a test.
SceneDef resolved_as(SceneDef scene, const Setting& setting);

/// The scene with the default iterations and tolerance.
SceneDef with_default_numerics(SceneDef scene);

/// Runs judge(id, scene) with the case's numerics and, if coupled, once more with the default iterations as
/// `id.default`.
template <class Judge>
void also_by_default(const std::string& id, const SceneDef& scene, const Setting& setting, Judge&& judge) {
  judge(id, scene);
  // the reference solves every time step to rounding: no bound on iterations makes another run of it
  if (setting.coupled() && setting.engine != "reference") judge(id + ".default", with_default_numerics(scene));
}

/// Whether the case is refused before it runs, with an error that contains `what`.
bool is_refused(const std::string& file, const std::vector<std::string>& overrides, const std::string& what);

/// Largest values over the time steps of a run.
struct Worst {
  std::int64_t contacts = 0;      // contact points, summed over all time steps
  std::int32_t iterations = 0;    // most in one time step
  double overlap = 0.0;           // deepest [m]
  double created = 0.0;           // energy created by contacts and repair, summed over the blocks that created any [J]
  double exchanged = 0.0;         // impulse given to the bodies, summed over blocks [N s]
  double momentum = 0.0;          // unexplained by the books, relative to the exchanged impulse
  double angular_momentum = 0.0;  // unexplained, relative to the exchanged impulse at the largest distance
  double energy = 0.0;            // unexplained, relative to the largest energy
};

/// A run that is observed.
class Watched {
 public:
  Watched(const SceneDef& scene, const Setting& setting);
  /// `threads` as in EngineOptions; they change no bit.
  Watched(const SceneDef& scene, Bodies bodies, const Setting& setting, int threads = 1);

  /// Advances in blocks and reads the books after each. The log keeps the last block.
  void advance(std::int64_t steps, std::int64_t block = 1);
  /// Advances in blocks and calls look() after each.
  template <class Look>
  void advance(std::int64_t steps, std::int64_t block, Look&& look) {
    for (std::int64_t done = 0; done < steps; done += block) {
      one_block(std::min(block, steps - done));
      look();
    }
  }

  Engine& engine() { return *engine_; }
  const Bodies& bodies() { return engine_->bodies(); }
  Ledger ledger() { return engine_->ledger(); }
  const StepLog& log() const { return log_; }
  const Worst& worst() const { return worst_; }
  const Setting& setting() const { return setting_; }
  Where where() const { return setting_.where(); }
  /// Contact points of the last time step.
  std::int32_t contacts_now() const { return log_.quality.back().contacts; }

 private:
  void one_block(std::int64_t steps);

  Setting setting_;
  std::unique_ptr<Engine> engine_;
  StepLog log_;
  Worst worst_;
  double contact_energy_ = 0.0;
  Ledger last_;
};

/// Judges a number of a case: it must lie in [0, limit]. A number listed in known_misses.txt must miss its limit.
void bound(const std::string& key, double computed, double limit, const std::string& unit, const Where& where);

/// Checks what every hard case requires: contacts, closed books, no energy created.
void expect_sound(const std::string& id, Watched& run);

/// Force of the current on floes that are held in place [N]: m k |U| U over 1 + k |U| dt. The divisor is there because
/// in each time step the drag acts before the wall stops the floe.
double held_push(const SceneDef& scene, const Bodies& bodies);

/// Total impulse of contacts with fixed bodies so far [N s].
Vec2 given_by_fixed(const Ledger& ledger);

/// Energy of the contact and repair channels so far [J]; negative is lost.
double contact_energy(const Ledger& ledger);

/// Overlaps of the bodies at their current positions.
struct Overlaps {
  double deepest = 0.0;     // [m]
  double most = 0.0;        // exceeded by 0.1 % of the touching pairs [m]
  double total = 0.0;       // sum over the pairs [m]
  double size_share = 0.0;  // deepest, relative to the size of the smaller floe
};
Overlaps overlaps(const Bodies& bodies);

/// Contact points stored by the engine. Coupled: those of its warm start, touching or about to touch. Independent:
/// those that touch.
std::size_t points_of(Watched& run);

/// Largest speed of a floe [m/s].
double fastest_floe(const Bodies& bodies);

/// Index of the first floe.
std::size_t first_floe_of(const Bodies& bodies);

}  // namespace gem::hard
