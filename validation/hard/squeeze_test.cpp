// A heavy body against light floes: between platform and wall (H2), the squeeze (H16), the bullet (H19).
#include <algorithm>
#include <cmath>

#include "gem/events/crushing.h"
#include "gem/field/field.h"
#include "validation/hard/hard.h"

namespace gem::hard {
namespace {

class HardSqueeze : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardSqueeze, ::testing::ValuesIn(verification::all_settings()),
                         verification::setting_name);
class HardField : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardField, ::testing::ValuesIn(large_settings()), verification::setting_name);

/// Depth at which crushing over a flat face of `width` has absorbed `energy` [m].
double crushing_depth(const SceneDef& scene, double thickness, double width, double energy) {
  return crushing_flat({scene.ice.crushing_pressure_Pa, scene.ice.pressure_area_exponent, thickness}, width, energy)
      .depth;
}

/// Runs a platform into ice at speed v in `direction`. Returns the largest speed in the opposite direction.
double speed_back(Watched& run, const SceneDef& scene, double direction) {
  double back = 0.0;
  const auto steps = static_cast<std::int64_t>(scene.run.duration_s / scene.numerics.time_step_s);
  run.advance(steps, 1, [&] { back = std::max(back, -direction * run.bodies().velocity[0].x); });
  return back;
}

void squeeze_floe(const std::string& id, const SceneDef& scene, const Setting& setting) {
  const double speed = 0.1, mass = 1e8;
  Watched run(scene, setting);
  EXPECT_NEAR(run.bodies().mass[0] / run.bodies().mass[2], 55556.0, 1.0);
  bound(id + ".rebound", speed_back(run, scene, 1.0) / speed, 0.01, "-", run.where());
  // The 2 m face of the floe absorbs all energy of the platform.
  bound(id + ".overlap", run.worst().overlap, crushing_depth(scene, 0.5, 2.0, 0.5 * mass * speed * speed), "m",
        run.where());
  bound(id + ".speed_left", std::fabs(run.bodies().velocity[0].x) / speed, 0.01, "-", run.where());
  // The wall has taken all momentum of the platform.
  const double given = -given_by_fixed(run.ledger()).x / (mass * speed);
  bound(id + ".momentum", std::fabs(given - 1.0), 0.01, "-", run.where());
  expect_sound(id, run);
}

TEST_P(HardSqueeze, H2_floe_between_platform_and_wall) {
  also_by_default("H2", read_hard_case("H02_squeezed_floe.toml", setting()), setting(),
                  [&](const std::string& id, const SceneDef& scene) { squeeze_floe(id, scene, setting()); });
}

void squeeze(const std::string& id, const std::string& member, const Setting& setting) {
  const SceneDef scene = read_hard_member("H16_squeeze.toml", member, setting);
  const double speed = length(scene.platform.start_velocity_m_per_s);
  const double energy = 0.5 * scene.platform.mass_kg * speed * speed;
  Watched run(scene, setting);
  bound(id + ".rebound", speed_back(run, scene, -1.0) / speed, 0.01, "-", setting.where());
  // A row of floes across the channel, in contact over half of its width, absorbs all energy of the barge.
  bound(id + ".overlap", run.worst().overlap, crushing_depth(scene, 0.5, 0.5 * scene.boundary.gap_m, energy), "m",
        setting.where());
  bound(id + ".speed_left", length(run.bodies().velocity[0]) / speed, 0.01, "-", setting.where());
  EXPECT_GT(given_by_fixed(run.ledger()).x, 0.5 * scene.platform.mass_kg * speed) << "the wall felt nothing of it";
  expect_sound(id, run);
}

TEST_P(HardField, H16_squeeze_at_10_cm_per_s) { squeeze("H16.v0.1", "H16_10", setting()); }
TEST_P(HardField, H16_squeeze_at_30_cm_per_s) { squeeze("H16.v0.3", "H16_30", setting()); }
TEST_P(HardField, H16_squeeze_at_1_m_per_s) { squeeze("H16.v1", "H16_100", setting()); }

TEST_P(HardField, H19_bullet) {
  const SceneDef scene = read_hard_case("H19_bullet.toml", setting());
  Watched run(scene, setting());
  EXPECT_NEAR(run.bodies().mass[0] / run.bodies().mass[1], 1e9, 1.0);
  double fastest = 0.0;
  run.advance(3000, 1, [&] { fastest = std::max(fastest, fastest_floe(run.bodies())); });
  const Bodies& b = run.bodies();
  // If it carried all 144 floes along, it would have lost 1.44e-7 of its speed.
  bound("H19.speed_lost", std::fabs(b.velocity[0].x - 1.0), 1.44e-7, "-", where());
  bound("H19.fastest", fastest, 2.0, "m/s", where());
  bound("H19.overlap", run.worst().overlap, 20e-3, "m", where());
  // The swept lane, reduced by half a floe diagonal on each side, must be empty.
  int in_wake = 0;
  for (std::size_t i = first_floe_of(b); i < b.count(); ++i)
    if (b.position[i].x < b.position[0].x && std::fabs(b.position[i].y - b.position[0].y) < 10.0) ++in_wake;
  bound("H19.in_wake", in_wake, 0.0, "floes", where());
  expect_sound("H19", run);
}

}  // namespace
}  // namespace gem::hard
