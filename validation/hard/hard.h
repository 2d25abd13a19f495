// Runs of the hard cases: read from cases/hard, watched time step by time step and judged by bounds.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "validation/verification/scenes.h"

namespace gem::hard {

using verification::Setting;
using verification::Where;

/// Every engine but the naive reference, with both solvers: for scenes where all pairs take too long.
std::vector<Setting> large_settings();

/// A case of cases/hard as the setting runs it: independent with the paper's contacts (chord middle, elastic stress).
SceneDef read_hard_case(const std::string& file, const Setting& setting,
                        const std::vector<std::string>& overrides = {});

/// One run of a case that is a sweep, by its name.
SceneDef read_hard_member(const std::string& file, const std::string& name, const Setting& setting,
                          const std::vector<std::string>& overrides = {});

/// The same for a scene made here.
SceneDef resolved_as(SceneDef scene, const Setting& setting);

/// The scene with the iterations and the tolerance that a case has unless it sets others.
SceneDef with_default_numerics(SceneDef scene);

/// Runs judge(id, scene) as the case asks and, coupled, once more with the default iterations, as `id.default`.
template <class Judge>
void also_by_default(const std::string& id, const SceneDef& scene, const Setting& setting, Judge&& judge) {
  judge(id, scene);
  // the reference solves every time step to rounding: no bound on iterations makes another run of it
  if (setting.coupled() && setting.engine != "reference") judge(id + ".default", with_default_numerics(scene));
}

/// Whether the case is refused before it runs, with an error that names `what`.
bool is_refused(const std::string& file, const std::vector<std::string>& overrides, const std::string& what);

/// Worst values over the time steps of a run.
struct Worst {
  std::int64_t contacts = 0;      // touching points over all time steps
  std::int32_t iterations = 0;    // most in one time step
  double overlap = 0.0;           // deepest [m]
  double created = 0.0;           // energy that contacts and repair gave in blocks where they gave [J]
  double exchanged = 0.0;         // impulse that the bodies were given, block by block [N s]
  double momentum = 0.0;          // what the books left unexplained, relative to what was exchanged
  double angular_momentum = 0.0;  // the same, relative to that at the farthest place
  double energy = 0.0;            // the same, relative to the largest energy
};

/// A run under watch.
class Watched {
 public:
  Watched(const SceneDef& scene, const Setting& setting);
  /// `threads` as in EngineOptions: they change no bit.
  Watched(const SceneDef& scene, Bodies bodies, const Setting& setting, int threads = 1);

  /// Advances in blocks and looks at the books after each; the log keeps the last block.
  void advance(std::int64_t steps, std::int64_t block = 1);
  /// The same, calling look() after each block.
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
  /// Touching points that the last time step had.
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

/// Judges a number of a case by its bound: it must lie in [0, bound]. What a solver is known to miss stands in
/// known_misses.txt and must be missed.
void bound(const std::string& key, double computed, double limit, const std::string& unit, const Where& where);

/// What every hard case asks for: contacts, closed books, no energy created.
void expect_sound(const std::string& id, Watched& run);

/// Force with which the current pushes floes that are held where they are [N]: m k |U| U, less what the drag falls
/// short because the wall lets go of a floe for one time step at a time, 1 + k |U| dt.
double held_push(const SceneDef& scene, const Bodies& bodies);

/// Total of what contacts with fixed bodies gave so far [N s].
Vec2 given_by_fixed(const Ledger& ledger);

/// Energy of the contact and repair channels so far: negative is lost [J].
double contact_energy(const Ledger& ledger);

/// Overlaps of the bodies as they stand.
struct Overlaps {
  double deepest = 0.0;     // [m]
  double most = 0.0;        // 99.9 % of the touching pairs are less deep [m]
  double total = 0.0;       // sum over the pairs [m]
  double size_share = 0.0;  // deepest, as a share of the smaller floe's size
};
Overlaps overlaps(const Bodies& bodies);

/// Contact points that the engine holds: coupled those of its warm start, touching or about to; independent those that
/// touch.
std::size_t points_of(Watched& run);

/// Fastest floe [m/s].
double fastest_floe(const Bodies& bodies);

/// Index of the first floe.
std::size_t first_floe_of(const Bodies& bodies);

}  // namespace gem::hard
