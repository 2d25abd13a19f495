// Jams: friction from none to very high (H13), a jam that lasts (H7), a hundred thousand floes (H11).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "gem/base/random.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/threads_asked.h"
#include "gem/field/field.h"
#include "gem/scene/check_scene.h"
#include "validation/agreement/jam.h"
#include "validation/hard/hard.h"
#include "validation/hard/tight_field.h"

namespace gem::hard {
namespace {

class HardJam : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardJam, ::testing::ValuesIn(large_settings()), verification::setting_name);
class LongHardJam : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, LongHardJam, ::testing::ValuesIn(large_settings()), verification::setting_name);

/// Limits for every jam.
constexpr double deepest_overlap = 20e-3;  // [m]
constexpr double most_overlap = 2e-3;      // exceeded by 0.1 % of the touching pairs [m]

/// Observes a jam: the deepest overlap of any time step, the overlaps after each block, and the impulse that walls and
/// platform take from the ice.
struct JamWatch {
  double deepest = 0.0;  // [m]
  Overlaps worst;
  Vec2 taken;         // [N s]
  double time = 0.0;  // [s]

  void look(Watched& run, std::int64_t steps, const SceneDef& scene) {
    const Ledger before = run.ledger();
    run.advance(steps, steps);
    taken -= given_by_fixed(run.ledger()) - given_by_fixed(before);
    for (const PlatformStep& step : run.log().platform) taken += step.ice_impulse;
    for (const StepQuality& quality : run.log().quality) deepest = std::max(deepest, quality.maximum_overlap);
    time += static_cast<double>(steps) * scene.numerics.time_step_s;
    const Overlaps now = overlaps(run.bodies());
    worst.most = std::max(worst.most, now.most);
    worst.size_share = std::max(worst.size_share, now.size_share);
  }
};

void judge_jam(const std::string& id, const JamWatch& watch, Watched& run, const SceneDef& scene, const Bodies& field) {
  bound(id + ".overlap", watch.deepest, deepest_overlap, "m", run.where());
  bound(id + ".overlap_99.9", watch.worst.most, most_overlap, "m", run.where());
  bound(id + ".overlap_share", watch.worst.size_share, 0.1, "-", run.where());
  // Drag pushes ice at rest; ice that was moving also brings its momentum once.
  double momentum = 0.0;
  for (std::size_t i = first_floe_of(field); i < field.count(); ++i) momentum += field.mass[i];
  momentum *= length(scene.current.velocity_m_per_s);
  const double most = held_push(scene, field) * watch.time + momentum;
  bound(id + ".force", length(watch.taken) / most, 1.0, "-", run.where());
  expect_sound(id, run);
}

constexpr std::int64_t half_minute = 600;

/// Largest distance between eight frictionless jams whose start speeds differ by at most `change`.
double apart_by_chance(const SceneDef& scene, const Bodies& after, double change, const Setting& setting) {
  double apart = 0.0;
  for (std::uint32_t start = 0; start < 8; ++start) {
    Bodies bodies = make_field(scene);
    RandomSequence numbers(Random(13, start));
    for (std::size_t i = first_floe_of(bodies); i < bodies.count(); ++i)
      bodies.velocity[i] += Vec2{numbers.uniform(-change, change), numbers.uniform(-change, change)};
    Watched run(scene, bodies, setting);
    run.advance(half_minute, 20);
    apart = std::max(apart, test::farthest_apart(run.bodies(), after));
  }
  return apart;
}

TEST_P(HardJam, H13_friction) {
  verification::check_value(
      "H13.mu10.refused", 1.0,
      is_refused("H13_friction.toml", {"ice.friction_ice=10.0"}, "allowed [0, 1.5]: ice has less friction") ? 1.0 : 0.0,
      0.0, "-", where());
  Bodies slippery;
  for (const char* friction : {"0", "1e-12", "1.2"}) {
    const std::string id = std::string("H13.mu") + friction;
    const SceneDef scene = read_hard_member("H13_friction.toml", std::string("H13_") + friction, setting());
    EXPECT_EQ(scene_warnings(scene).size() >= 2, scene.ice.friction_ice > 1.1);
    Watched run(scene, setting());
    const Bodies field = run.bodies();
    run.advance(half_minute, 20);
    if (slippery.count() == 0) slippery = run.bodies();
    if (std::string(friction) == "1e-12") {
      // Friction changes speeds by 1e-12 x 0.5 m/s in a time step. A jam amplifies any such change where contacts open
      // and iterations restart by a threshold. So friction may change the jam as much as equally small changes of the
      // start do; a ninth sample lies within ten times the largest of eight.
      const SceneDef frictionless = read_hard_member("H13_friction.toml", "H13_0", setting());
      const double change = 1e-12 * length(scene.current.velocity_m_per_s);
      bound("H13.apart", test::farthest_apart(run.bodies(), slippery),
            10.0 * apart_by_chance(frictionless, slippery, change, setting()), "m", where());
    }
    JamWatch watch;
    watch.deepest = run.worst().overlap;  // the half minute before counts too
    for (int i = 0; i < 60; ++i) watch.look(run, 20, scene);
    judge_jam(id, watch, run, scene, field);
  }
}

TEST_P(HardJam, H7_minute_of_jam) {
  const SceneDef scene = resolved_as(agreement::jam_scene(setting().solver), setting());
  const Bodies field = agreement::drifting_field(scene);
  Watched run(scene, field, setting());
  run.engine().restore(agreement::jam(scene, field));
  JamWatch watch;
  for (int i = 0; i < 60; ++i) watch.look(run, 20, scene);
  EXPECT_GT(run.contacts_now(), agreement::contacts_wanted) << "the jam is gone";
  judge_jam("H7.minute", watch, run, scene, field);
}

/// A day takes long. GEM_ENGINE chooses another engine (the bits are the same), and GEM_THREADS limits the threads.
Setting setting_of_the_day(Setting setting) {
  if (const char* engine = std::getenv("GEM_ENGINE")) setting.engine = engine;
  return setting;
}

/// Prints one line per simulated hour.
void tell_hour(int hour, const JamWatch& watch, Watched& run) {
  std::printf("hour %2d: %zu points, overlap %.3g m at most in this half day, 99.9 %% of it %.3g m\n", hour,
              points_of(run), watch.deepest, watch.worst.most);
  std::fflush(stdout);
}

TEST_P(LongHardJam, H7_day_of_jam) {
  const SceneDef scene = read_hard_case("H07_day_of_jam.toml", setting());
  const Bodies field = make_field(scene);
  Watched run(scene, field, setting_of_the_day(setting()), test::threads_asked(0));
  const auto hour = static_cast<std::int64_t>(3600.0 / scene.numerics.time_step_s);
  JamWatch first, last;
  for (int minute = 0; minute < 24 * 60; ++minute) {
    JamWatch& half = minute < 12 * 60 ? first : last;
    half.look(run, hour / 60, scene);
    if (minute % 60 == 59) tell_hour((minute + 1) / 60, half, run);
  }
  EXPECT_GT(points_of(run), 1000u) << "the ice is gone";
  judge_jam("H7.day.first_half", first, run, scene, field);
  judge_jam("H7.day.second_half", last, run, scene, field);
  bound("H7.day.growth", last.worst.most, std::max(first.worst.most, most_overlap), "m", run.where());
}

void press_tight_field(const std::string& id, int columns, int rows, double seconds, const Setting& setting) {
  const SceneDef scene = resolved_as(tight_scene(columns, rows), setting);
  const Bodies field = make_field(scene);
  Watched run(scene, field, setting, 0);
  EXPECT_NEAR(cover_of(scene, field), 0.9, 1e-9);
  JamWatch watch;
  for (double t = 0.0; t < seconds; t += 1.0) watch.look(run, 20, scene);
  EXPECT_GT(points_of(run), static_cast<std::size_t>(8 * rows)) << "fewer than some rows have come to rest";
  judge_jam(id, watch, run, scene, field);
}

TEST_P(HardJam, H11_thousand_floes_at_nine_tenths) { press_tight_field("H11.n1000", 40, 25, 100.0, setting()); }

TEST_P(LongHardJam, H11_hundred_thousand_floes_at_nine_tenths) {
  press_tight_field("H11.n1e5", 400, 250, 100.0, setting());
}

}  // namespace
}  // namespace gem::hard
