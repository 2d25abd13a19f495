// Floes in a notch, under the push of a current: one too wide for it (H20), one with a little room in it (H21).
#include <algorithm>
#include <cmath>

#include "gem/engine/testing/same_bits.h"
#include "gem/field/field.h"
#include "validation/hard/hard.h"

namespace gem::hard {
namespace {

class HardNotch : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardNotch, ::testing::ValuesIn(verification::coupled_settings()),
                         verification::setting_name);

/// The field of the case, which starts with an overlap: made with the floes outside the notch.
Bodies field_of(const SceneDef& scene) {
  SceneDef apart = scene;
  for (FloeDef& floe : apart.floe) floe.position_m.x -= 40.0;
  Bodies bodies = make_field(apart);
  for (std::size_t i = first_floe_of(bodies); i < bodies.count(); ++i) bodies.position[i].x += 40.0;
  return bodies;
}

TEST_P(HardNotch, H20_a_floe_too_wide_for_its_notch) {
  const std::string file = "H20_notch.toml";
  verification::check_value("H20.refused", 1.0, is_refused(file, {}, "overlap at the start") ? 1.0 : 0.0, 0.0, "-",
                            where());
  const SceneDef scene = read_hard_case(file, setting());
  Watched run(scene, field_of(scene), setting());
  run.advance(4000, 20);
  const double push = held_push(scene, run.bodies());
  double force = 0.0, moving = 0.0;
  Bodies before = run.bodies();
  run.advance(1000, 1, [&] {
    force -= run.log().platform.back().mooring_impulse.x / (1000.0 * scene.numerics.time_step_s);
    moving = std::max(moving, test::farthest_apart(before, run.bodies()) / scene.numerics.time_step_s);
    before = run.bodies();
  });
  bound("H20.force", std::fabs(force / push - 1.0), 1e-3, "-", where());
  bound("H20.moving", moving, 2e-3, "m/s", where());
  bound("H20.overlap", overlaps(run.bodies()).deepest, 0.011, "m", where());
  EXPECT_GE(run.contacts_now(), 6) << "the floes do not rest on each other and in the notch";
  expect_sound("H20", run);
}

TEST_P(HardNotch, H21_a_floe_with_room_in_its_notch) {
  const SceneDef scene = read_hard_case("H21_room_in_a_notch.toml", setting());
  Watched run(scene, setting());
  double residual = 0.0;
  std::int64_t in_notch = 0;
  run.advance(8000, 1, [&] {
    residual = std::max(residual, run.log().quality.back().residual);
    if (run.contacts_now() >= 4) ++in_notch;
  });
  EXPECT_GT(in_notch, 4000) << "the floes do not rest on each other and in the notch";
  // the default tolerance of 25 November 2026, stricter than the present one
  const double tolerance = 1e-3 * length(scene.current.velocity_m_per_s);
  bound("H21.residual", residual, tolerance, "m/s", where());
  // a time step adds what the tolerance allows at each of the four contacts of a floe, and takes back `repair_share`
  const double added = 4.0 * tolerance * scene.numerics.time_step_s;
  bound("H21.overlap", run.worst().overlap, added / scene.numerics.repair_share, "m", where());
  expect_sound("H21", run);
}

}  // namespace
}  // namespace gem::hard
