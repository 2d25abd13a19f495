// Contacts that last: a fast spin that comes to rest (H8), a locked wedge (H10), a corner (H15).
#include <algorithm>
#include <cmath>

#include "gem/field/field.h"
#include "validation/hard/hard.h"

namespace gem::hard {
namespace {

class HardRest : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardRest, ::testing::ValuesIn(verification::all_settings()),
                         verification::setting_name);
class LongHardRest : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, LongHardRest, ::testing::ValuesIn(large_settings()), verification::setting_name);

TEST_P(HardRest, H8_an_eighth_of_a_radian_a_step) {
  const bool refused = is_refused("H08_spin.toml", {"numerics.time_step_s=0.05"}, "the time step is too long");
  verification::check_value("H8.refused", 1.0, refused ? 1.0 : 0.0, 0.0, "-", where());
  const SceneDef scene = read_hard_case("H08_spin.toml", setting());
  EXPECT_EQ(scene.floe[0].spin_rad_per_s * scene.numerics.time_step_s, 0.125);
  Watched run(scene, setting());
  double spin = 0.0, fastest = 0.0;
  run.advance(9600, 1, [&] {
    for (const double s : run.bodies().spin) spin = std::max(spin, std::fabs(s));
    fastest = std::max(fastest, fastest_floe(run.bodies()));
  });
  bound("H8.spin", spin, 10.0, "rad/s", where());
  // At most the speed of the floe's corner, 7.07 m from the centre.
  bound("H8.fastest", fastest, 10.0 * 5.0 * std::sqrt(2.0), "m/s", where());
  // No deeper than a corner of the spinning floe moves in one time step, 0.88 m, and the approach in one time step.
  const double swept = (10.0 * 5.0 * std::sqrt(2.0) + 0.25) * scene.numerics.time_step_s;
  bound("H8.overlap", run.worst().overlap, swept, "m", where());
  bound("H8.fastest_left", fastest_floe(run.bodies()), 0.25, "m/s", where());
  expect_sound("H8", run);
}

/// Largest distance of the case's floe from its position after `settling` time steps.
double creep(const std::string& id, const std::string& file, std::int64_t settling, std::int64_t steps,
             const Setting& setting) {
  const SceneDef scene = read_hard_case(file, setting);
  Watched run(scene, setting);
  run.advance(settling, 100);
  const std::size_t floe = first_floe_of(run.bodies());
  const Vec2 place = run.bodies().position[floe];
  double farthest = 0.0;
  std::int64_t touched = 0, blocks = 0;
  run.advance(steps, 1000, [&] {
    farthest = std::max(farthest, length(run.bodies().position[floe] - place));
    for (const StepQuality& quality : run.log().quality)
      if (quality.contacts > 0 || quality.iterations > 0) ++touched;
    ++blocks;
  });
  EXPECT_GT(touched, blocks * 500) << "the floe is not held";
  expect_sound(id, run);
  return farthest;
}

TEST_P(HardRest, H10_locked_wedge) {
  // the reference takes 0.1 ms a time step: a tenth of the time, for a tenth of the bound
  const std::int64_t shorter = setting().engine == "reference" ? 10 : 1;
  const double farthest = creep("H10", "H10_locked_wedge.toml", 2000, 1000000 / shorter, setting());
  bound("H10.creep", farthest, 1e-3 / static_cast<double>(shorter), "m", where());
}

TEST_P(HardRest, H15_corner) {
  bound("H15.1e5.creep", creep("H15.1e5", "H15_corner.toml", 2000, 100000, setting()), 1e-6, "m", where());
}

TEST_P(LongHardRest, H15_corner) {
  bound("H15.1e7.creep", creep("H15.1e7", "H15_corner.toml", 2000, 10000000, setting()), 1e-6, "m", where());
}

}  // namespace
}  // namespace gem::hard
