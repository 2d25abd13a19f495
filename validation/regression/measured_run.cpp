// Sums the logs of a run and writes the numbers of its row.
#include "validation/regression/measured_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gem/base/number_text.h"
#include "gem/field/field.h"
#include "gem/record/hits.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/run/run_scene.h"

namespace gem::regression {
namespace {

/// Sums over the steps of a run.
struct Totals {
  std::int64_t contacts = 0;
  std::int64_t platform_contacts = 0;
  std::int64_t iterations = 0;
  std::vector<Hit> hits;
  double deepest_overlap = 0.0;  // [m]
  Vec2 impulse;                  // of the ice on the platform [N s]
  double yaw_impulse = 0.0;      // about the platform's centre [N m s]
  Vec2 window_impulse;           // in the current window [N s]
  double largest_impulse = 0.0;  // of a complete window [N s]
  double offset_sum = 0.0;       // of the platform along x, summed over the steps [m]
};

/// Number of steps between two readings of the ledger. Fixed, because the scale of a residual is the largest that was
/// read.
constexpr std::int64_t block_steps = 64;

std::int64_t window_steps(const SceneDef& scene) {
  return std::max<std::int64_t>(1, std::llround(scene.output.force_window_s / scene.numerics.time_step_s));
}

void add(Totals& totals, const SceneDef& scene, std::int64_t first_step, const StepLog& log) {
  for (const StepQuality& quality : log.quality) {
    totals.contacts += quality.contacts;
    totals.iterations += quality.iterations;
    totals.deepest_overlap = std::max(totals.deepest_overlap, quality.maximum_overlap);
  }
  std::int64_t step = first_step;
  for (const PlatformStep& platform : log.platform) {
    totals.platform_contacts += platform.contacts;
    totals.impulse += platform.ice_impulse;
    totals.yaw_impulse += platform.ice_yaw_impulse;
    totals.offset_sum += platform.position.x - scene.platform.anchor_m.x;
    totals.window_impulse += platform.ice_impulse;
    if (++step % window_steps(scene) != 0) continue;
    totals.largest_impulse = std::max(totals.largest_impulse, length(totals.window_impulse));
    totals.window_impulse = {};
  }
}

std::int64_t active_floes(const Bodies& bodies) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < bodies.count(); ++i) count += bodies.active[i] && bodies.kind[i] == BodyKind::floe;
  return count;
}

/// Builds the cells of a row in order.
class Cells {
 public:
  void text(const std::string& column, const std::string& value) { cells_.push_back({column, value}); }
  void count(const std::string& column, std::int64_t value) { text(column, std::to_string(value)); }
  /// Nine digits show every change that matters; the hash shows all others.
  void number(const std::string& column, double value, int digits = 9) { text(column, number_text(value, digits)); }
  std::vector<Cell> take() { return std::move(cells_); }

 private:
  std::vector<Cell> cells_;
};

void add_platform(Cells& cells, const SceneDef& scene, const Totals& totals, Engine& engine) {
  const double steps = static_cast<double>(engine.step());
  const double window = static_cast<double>(window_steps(scene)) * scene.numerics.time_step_s;
  cells.number("mean_force_x_N", totals.impulse.x / (steps * scene.numerics.time_step_s));
  cells.number("largest_window_force_N", totals.largest_impulse / window);
  cells.number("impulse_x_N_s", totals.impulse.x);
  cells.number("impulse_y_N_s", totals.impulse.y);
  cells.number("yaw_impulse_N_m_s", totals.yaw_impulse);
  const Vec2 offset = engine.bodies().position[0] - scene.platform.anchor_m;
  cells.number("mean_offset_x_m", totals.offset_sum / steps);
  cells.number("last_offset_x_m", offset.x);
  cells.number("last_offset_y_m", offset.y);
  cells.number("last_spin_rad_per_s", engine.bodies().spin[0]);
}

void add_books(Cells& cells, const Ledger& ledger) {
  for (std::size_t c = 0; c < ledger.channel.size(); ++c)
    cells.number(std::string(channel_name(Channel(c))) + "_J", ledger.channel[c].energy);
  cells.number("energy_now_J", ledger.now.energy);
  const LedgerResidual left = residual(ledger);
  cells.number("residual_momentum", left.momentum, 3);
  cells.number("residual_energy", left.energy, 3);
}

}  // namespace

MeasuredRun measured(const ListedRun& run, const EngineOptions& options) {
  const SceneDef scene = scene_of(run);
  const auto engine = make_engine(scene, make_field(scene), options);
  Totals totals;
  StepLog log;
  Hits hits({scene.output.hit_release_s, scene.output.event_speed_m_per_s}, scene.numerics.time_step_s);
  const std::int64_t steps = steps_of(scene);
  while (engine->step() < steps) {
    log.clear();
    const std::int64_t first_step = engine->step();
    engine->advance(std::min(block_steps, steps - first_step), log);
    add(totals, scene, first_step, log);
    hits.add(log.events, engine->step(), totals.hits);
    engine->ledger();
  }
  hits.end_all(totals.hits);
  Cells cells;
  cells.text("state_hash", hash_text(engine->state_hash()));
  cells.count("steps", steps);
  cells.number("simulated_s", static_cast<double>(steps) * scene.numerics.time_step_s);
  cells.count("contacts", totals.contacts);
  cells.count("platform_contacts", totals.platform_contacts);
  cells.count("iterations", totals.iterations);
  cells.count("events", static_cast<std::int64_t>(totals.hits.size()));
  cells.count("active_floes", active_floes(engine->bodies()));
  cells.number("deepest_overlap_m", totals.deepest_overlap);
  add_platform(cells, scene, totals, *engine);
  add_books(cells, engine->ledger());
  return {{run.name, cells.take()}, totals.contacts, totals.platform_contacts};
}

}  // namespace gem::regression
