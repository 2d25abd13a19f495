// The laws of contact, checked in single time steps: complementarity, friction cone, dissipation.
#include <algorithm>
#include <cmath>

#include "gem/field/field.h"
#include "validation/agreement/jam.h"
#include "validation/hard/contact_residuals.h"
#include "validation/hard/hard.h"
#include "validation/hard/tight_field.h"

namespace gem::hard {
namespace {

class HardResiduals : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardResiduals, ::testing::ValuesIn(verification::coupled_settings()),
                         verification::setting_name);

/// Checks `steps` single time steps after `settling` others.
void judge_moments(const std::string& id, const SceneDef& scene, const Setting& setting, std::int64_t settling,
                   std::int64_t steps) {
  Watched run(scene, setting);
  run.advance(settling, settling);
  ContactResiduals worst;
  EngineState before = run.engine().save();
  run.advance(steps, 1, [&] {
    const EngineState after = run.engine().save();
    worst.merge(contact_residuals(scene, before, after));
    before = after;
  });
  EXPECT_GT(worst.points, steps) << "too few contacts to judge";
  EXPECT_EQ(worst.without_point, 0);
  // What a point may still ask for: 9 residuals for rectangles, 10.4 for the worst of these floes (derived in
  // gem/engine/testing/speed_still_asked.h). 10 is chosen, also for slip. No more than 1e-3 is asked of the default,
  // which is wider: these scenes are small.
  const double speed = length(scene.current.velocity_m_per_s);
  const double allowed = 10.0 * std::min(scene.numerics.residual_tolerance, 1e-3) * speed;
  bound(id + ".pull", worst.pull, 1e-12 * speed, "m/s", run.where());
  bound(id + ".cone", worst.cone, 1e-12 * speed, "m/s", run.where());
  bound(id + ".closing", worst.closing, allowed, "m/s", run.where());
  bound(id + ".complementarity", worst.complementarity, allowed, "m/s", run.where());
  bound(id + ".slip", worst.slip, allowed, "m/s", run.where());
  expect_sound(id, run);
}

TEST_P(HardResiduals, R1_column) {
  also_by_default("R1.column", read_hard_member("H01_columns.toml", "H01_10", setting()), setting(),
                  [&](const std::string& id, const SceneDef& scene) { judge_moments(id, scene, setting(), 400, 100); });
}

TEST_P(HardResiduals, R2_tight_field_with_friction) {
  // Iterated until the tolerance ends the iterations, not their maximum number, because the tolerance is judged.
  SceneDef converged = resolved_as(tight_scene(10, 6), setting());
  converged.numerics.residual_tolerance = 1e-7;
  converged.numerics.iterations_maximum = 5000;
  also_by_default("R2.tight", converged, setting(),
                  [&](const std::string& id, const SceneDef& scene) { judge_moments(id, scene, setting(), 1000, 50); });
}

TEST_P(HardResiduals, R3_wedge) {
  judge_moments("R3.wedge", read_hard_case("H10_locked_wedge.toml", setting()), setting(), 1000, 100);
}

TEST_P(HardResiduals, A_wrong_impulse_is_seen) {
  const SceneDef scene = read_hard_member("H01_columns.toml", "H01_10", setting());
  Watched run(scene, setting());
  run.advance(400, 400);
  const EngineState before = run.engine().save();
  run.advance(1);
  EngineState after = run.engine().save();
  ASSERT_FALSE(after.impulse_value.empty());
  after.impulse_value[0].impulse = {
      -450.0, 900.0, 0.0};  // an impulse that pulls, and friction without a coefficient: 0.01 and 0.02 m/s on 45 t
  const ContactResiduals seen = contact_residuals(scene, before, after);
  EXPECT_GT(seen.pull, 0.005);
  EXPECT_GT(seen.cone, 0.005);
}

}  // namespace
}  // namespace gem::hard
