// The momentum ledger without walls (H17): no impulse that contacts exchange is lost.
#include <algorithm>
#include <cmath>

#include "gem/base/random.h"
#include "gem/field/field.h"
#include "validation/hard/hard.h"

namespace gem::hard {
namespace {

class HardLedger : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardLedger, ::testing::ValuesIn(verification::all_settings()),
                         verification::setting_name);

/// Half of the sum of all momentum changes in one time step: without drag, a lower bound on the exchanged impulse [N
/// s].
double passed_on(const Bodies& before, const Bodies& after) {
  double sum = 0.0;
  for (std::size_t i = 0; i < after.count(); ++i)
    sum += 0.5 * after.mass[i] * length(after.velocity[i] - before.velocity[i]);
  return sum;
}

/// Momentum that the books do not explain [N s].
double unexplained(const Ledger& ledger) { return residual(ledger).momentum * ledger.momentum_scale; }

TEST_P(HardLedger, H17_inward_rush) {
  // The floes of the case without current and platform: they can only push each other.
  SceneDef scene = read_hard_case("H17_no_walls.toml", setting());
  scene.platform.present = false;
  scene.water.drag_law = DragLaw::none;
  Bodies bodies = make_field(scene);
  const Vec2 middle{scene.floes.start_x_m + 0.5 * scene.floes.length_m, 0.0};
  RandomSequence numbers(Random(17, 1));
  for (std::size_t i = first_floe_of(bodies); i < bodies.count(); ++i) {
    bodies.velocity[i] = -0.02 * (bodies.position[i] - middle);
    bodies.spin[i] = numbers.uniform(-0.01, 0.01);
  }
  Watched run(scene, bodies, setting());
  double exchanged = 0.0;
  Bodies before = run.bodies();
  run.advance(16000, 1, [&] {
    exchanged += passed_on(before, run.bodies());
    before = run.bodies();
  });
  EXPECT_GT(exchanged, 0.0);
  bound("H17.rush.momentum", unexplained(run.ledger()) / exchanged, 1e-13, "-", where());
  expect_sound("H17.rush", run);
}

TEST_P(HardLedger, H17_stream_on_the_platform) {
  const SceneDef scene = read_hard_case("H17_no_walls.toml", setting());
  Watched run(scene, setting());
  double exchanged = 0.0;
  std::int64_t struck = 0;
  run.advance(16000, 1, [&] {
    const PlatformStep& step = run.log().platform.back();
    exchanged += length(step.ice_impulse);
    if (step.contacts > 0) ++struck;
  });
  EXPECT_GT(struck, 100) << "the ice missed the platform";
  // Impulse exchanged with the platform, the water and the mooring.
  exchanged += run.worst().exchanged;
  bound("H17.stream.momentum", unexplained(run.ledger()) / exchanged, 1e-13, "-", where());
  expect_sound("H17.stream", run);
}

}  // namespace
}  // namespace gem::hard
