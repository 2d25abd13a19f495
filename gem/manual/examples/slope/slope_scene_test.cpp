// A floe on a sloping sea, as a case that engines run: against closed form. A case on a level sea keeps its bits.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>

#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

constexpr std::size_t floe_id = 1;

/// One square floe of 10 m in still water; `more` is added to the case.
SceneDef scene_of(const std::string& more) {
  return parse_scene(R"(
    [current]
    velocity_m_per_s = [0.0, 0.0]
    [boundary]
    present = false
    [platform]
    present = false
    [contact]
    solver = "coupled" # the reference divides no time step then, so rounding is that of the time steps
    [output]
    retire_x_m = 1e6
    [floes]
    source = "listed"
    [[floe]]
    outline_m = [[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0]]
    position_m = [0.0, 0.0]
  )" + more,
                     "slope");
}

class SlopeOnEngine : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Engine> after(const SceneDef& scene, std::int64_t steps) {
    auto engine = make_engine(scene, make_field(scene), {GetParam(), 1});
    StepLog log;
    engine->advance(steps, log);
    return engine;
  }
};
INSTANTIATE_TEST_SUITE_P(Engines, SlopeOnEngine, ::testing::ValuesIn(engine_names()),
                         [](const auto& engine) { return engine.param; });

TEST_P(SlopeOnEngine, WithoutWaterDragTheFloeFollowsTheClosedForm) {
  const SceneDef scene = scene_of(R"(
    [water]
    drag_law = "none"
    [slope]
    rise = [-6e-6, 8e-6]
  )");
  const std::int64_t steps = 12000;
  const auto engine = after(scene, steps);
  const Bodies& b = engine->bodies();
  const double t = static_cast<double>(steps) * scene.numerics.time_step_s;
  const double speed = 9.81 * 1e-5 * t, path = 0.5 * speed * t;
  // each time step is exact, so its rounding is left
  const double rounding = 4e-16 * static_cast<double>(steps);
  EXPECT_NEAR(b.velocity[floe_id].x, 0.6 * speed, rounding);
  EXPECT_NEAR(b.velocity[floe_id].y, -0.8 * speed, rounding);
  EXPECT_NEAR(b.position[floe_id].x, 0.6 * path, rounding * t);
  EXPECT_NEAR(b.position[floe_id].y, -0.8 * path, rounding * t);

  const LedgerResidual left = residual(engine->ledger());
  EXPECT_LT(left.momentum, 1e-12);
  EXPECT_LT(left.angular_momentum, 1e-12);
  EXPECT_LT(left.energy, 1e-12);
}

TEST_P(SlopeOnEngine, SlopeAndWaterBalanceAtTheDriftSpeed) {
  const SceneDef scene = scene_of(R"(
    [slope]
    rise = [0.0, -1e-5]
  )");
  const auto engine = after(scene, 60000);
  const Bodies& b = engine->bodies();
  // k v^2 = g S
  const double drag = b.drag[floe_id], drift = std::sqrt(9.81 * 1e-5 / drag);
  // the two act one after the other: the speed is off by what one of them changes in a time step
  EXPECT_NEAR(b.velocity[floe_id].y, drift, 9.81 * 1e-5 * scene.numerics.time_step_s);
  EXPECT_NEAR(b.velocity[floe_id].x, 0.0, 1e-15);
  EXPECT_GT(drift, 0.02);
}

TEST(SlopeScene, ALevelSeaLeavesTheBitsOfTheProgramWithoutTheLaw) {
  const char *expected = std::getenv("HASH_WITHOUT_LAW"), *file = std::getenv("CASE_WITHOUT_LAW");
  ASSERT_TRUE(expected && file) << "scripts/check_example_law.sh sets them";
  const SceneDef scene = read_scene(file);
  auto engine = make_engine(scene, make_field(scene), {"cpu", 1});
  StepLog log;
  engine->advance(static_cast<std::int64_t>(std::lround(scene.run.duration_s / scene.numerics.time_step_s)), log);
  std::ostringstream hash;
  hash << std::hex << std::setw(16) << std::setfill('0') << engine->state_hash();
  EXPECT_EQ(hash.str(), expected);
}

TEST(SlopeScene, KeysAreChecked) {
  EXPECT_THROW(scene_of("[slope]\nrise = [1.0, 0.0]\n"), std::exception);
  EXPECT_EQ(scene_of("").slope.rise.x, 0.0);
}

}  // namespace
}  // namespace gem
