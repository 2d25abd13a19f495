// Columns pressed against a wall: many contacts in series (H1), long time steps (H9), a mass ratio of one thousand
// (H14).
#include <algorithm>
#include <cmath>

#include "gem/field/field.h"
#include "validation/hard/hard.h"

namespace gem::hard {
namespace {

class HardColumn : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardColumn, ::testing::ValuesIn(verification::all_settings()),
                         verification::setting_name);
class HardBigColumn : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardBigColumn, ::testing::ValuesIn(large_settings()), verification::setting_name);

class LongHardColumn : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, LongHardColumn, ::testing::ValuesIn(large_settings()), verification::setting_name);

/// Force of the current on one floe of the columns [N].
constexpr double push = 562.5;

/// Mean force on the wall over the next `steps` [N].
double wall_force(Watched& run, std::int64_t steps, double dt) {
  const Vec2 before = given_by_fixed(run.ledger());
  run.advance(steps, steps);
  return length(given_by_fixed(run.ledger()) - before) / (static_cast<double>(steps) * dt);
}

/// Relative errors of the force on the wall over the last half minute.
struct ForceError {
  double worst = 0.0;        // of the means over a second, against the held push
  double worst_exact = 0.0;  // of the means over a second, against the closed form
  double mean = 0.0;         // of the mean over the half minute, against the held push
};

/// A second is long against a time step and short against the half minute. The worst of thirty seconds counts, so that
/// a rattling column cannot pass by luck.
ForceError force_error(Watched& run, const SceneDef& scene, double exact) {
  constexpr int seconds = 30;
  const std::int64_t steps = std::llround(1.0 / scene.numerics.time_step_s);
  run.advance(seconds * steps, steps);
  ForceError error;
  for (int second = 0; second < seconds; ++second) {
    const double force = wall_force(run, steps, scene.numerics.time_step_s);
    const double off = force / held_push(scene, run.bodies()) - 1.0;
    error.worst = std::max(error.worst, std::fabs(off));
    error.worst_exact = std::max(error.worst_exact, std::fabs(force / exact - 1.0));
    error.mean += off / seconds;
  }
  error.mean = std::fabs(error.mean);
  return error;
}

struct ColumnBars {
  double force;    // relative
  double overlap;  // sum over the column [m]
};

void press(const std::string& id, const SceneDef& scene, int count, const ColumnBars& bars, const Setting& setting) {
  Watched run(scene, setting);
  const double exact = count * push;
  const ForceError force = force_error(run, scene, exact);
  bound(id + ".force", force.worst, bars.force, "-", run.where());
  // The closed form has no lag of the drag; in a time step the drag is k U dt too low.
  bound(id + ".force_exact", force.worst_exact, bars.force + 0.05 * 0.5 * scene.numerics.time_step_s, "-", run.where());
  bound(id + ".force_mean", force.mean, bars.force, "-", run.where());
  bound(id + ".total_overlap", overlaps(run.bodies()).total, bars.overlap, "m", run.where());
  expect_sound(id, run);
  if (setting.coupled()) return;
  // independent: the elastic stress that carries a force F is F (1 + omega dt)^2 / k deep, with omega^2 = k / m. The
  // contact at the wall is the deepest, and its force never exceeds the whole push.
  const double swing = std::sqrt(scene.contact.elastic_stiffness_N_per_m / 45000.0) * scene.numerics.time_step_s;
  bound(id + ".elastic_depth", run.worst().overlap,
        2.0 * exact * (1.0 + swing) * (1.0 + swing) / scene.contact.elastic_stiffness_N_per_m, "m", run.where());
}

void press_column(int count, const ColumnBars& bars, const Setting& setting) {
  const std::string number = std::to_string(count);
  also_by_default("H1.n" + number, read_hard_member("H01_columns.toml", "H01_" + number, setting), setting,
                  [&](const std::string& id, const SceneDef& scene) { press(id, scene, count, bars, setting); });
}

TEST_P(HardColumn, H1_column_of_10) { press_column(10, {1e-3, 1e-3}, setting()); }
TEST_P(HardBigColumn, H1_column_of_100) { press_column(100, {1e-3, 1e-3}, setting()); }
TEST_P(LongHardColumn, H1_column_of_1000) { press_column(1000, {1e-2, 20e-3}, setting()); }

TEST_P(HardColumn, H9_long_steps) {
  for (const int factor : {1, 10, 100, 1000}) {
    const std::string id = "H9.x" + std::to_string(factor);
    const double dt = 0.05 * factor;
    if (factor >= 100) {
      const bool refused = is_refused("H09_long_steps.toml",
                                      {"numerics.time_step_s=" + std::to_string(dt), "output.platform_interval_s=100.0",
                                       "output.force_window_s=100.0", "output.floes_interval_s=100.0"},
                                      "the time step is too long");
      verification::check_value(id + ".refused", 1.0, refused ? 1.0 : 0.0, 0.0, "-", where());
      continue;
    }
    const SceneDef scene = read_hard_member("H09_long_steps.toml", "H09_" + std::to_string(factor), setting());
    Watched run(scene, setting());
    run.advance(static_cast<std::int64_t>(100.0 / dt));
    // An overlap is seen at the end of a time step: it is no deeper than the path of one time step.
    bound(id + ".overlap", run.worst().overlap, 0.5 * dt, "m", where());
    bound(id + ".fastest", fastest_floe(run.bodies()), 0.5, "m/s", where());
    expect_sound(id, run);
  }
}

void press_layers(const std::string& id, const SceneDef& scene, const Setting& setting) {
  Watched run(scene, setting);
  const ForceError force = force_error(run, scene, held_push(scene, make_field(scene)));
  bound(id + ".force", force.worst, 1e-3, "-", run.where());
  bound(id + ".force_mean", force.mean, 1e-3, "-", run.where());
  bound(id + ".total_overlap", overlaps(run.bodies()).total, 1e-3, "m", run.where());
  expect_sound(id, run);
}

TEST_P(HardColumn, H14_thin_between_thick) {
  const bool refused =
      is_refused("H14_thickness.toml", {"floe=[{outline_m=[[0,0],[9,0],[0,9]],thickness_m=0.001}]"}, "thickness_m");
  verification::check_value("H14.1mm.refused", 1.0, refused ? 1.0 : 0.0, 0.0, "-", where());
  SceneDef scene = read_hard_case("H14_thickness.toml", setting());
  const auto judge = [&](const std::string& id, const SceneDef& pressed) { press_layers(id, pressed, setting()); };
  also_by_default("H14.1cm", scene, setting(), judge);
  scene.floe[1].thickness_m = 0.001;
  also_by_default("H14.1mm", scene, setting(), judge);
}

}  // namespace
}  // namespace gem::hard
