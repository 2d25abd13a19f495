// Each experiment changes what it says, and the platform's record still holds exactly the impulses that move it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "baseline_box2d/box2d_options.h"
#include "baseline_box2d/register_box2d.h"
#include "gem/base/error.h"
#include "gem/engine/engine.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem::baseline {
namespace {

EngineOptions with(const std::string& experiment) {
  register_box2d();
  EngineOptions options{"box2d", 1};
  if (!experiment.empty()) options.baseline_settings = {experiment};
  return options;
}

struct Outcome {
  std::uint64_t hash = 0;
  std::int64_t hits = 0;  // on the platform
  std::string method;
};

/// A crowd of floes around an unmoored platform. Fails unless momentum is conserved to float precision.
Outcome outcome(const std::string& experiment) {
  SceneDef scene = test::busy_scene(15);
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.ice.friction_ice = 0.4;
  scene.ice.friction_structure = 0.1;  // Box2D's mixed coefficient: 0.2
  scene.platform_drag.present = false;
  const auto engine = make_engine(scene, test::busy_field(scene), with(experiment));
  StepLog log;
  engine->advance(400, log);
  std::int64_t hits = 0;
  for (const PlatformStep& step : log.platform) hits += step.contacts;
  EXPECT_LT(residual(engine->ledger()).momentum, 400.0 * 0x1p-24) << experiment;
  return {engine->state_hash(), hits, engine->method()};
}

TEST(Experiments, EachIsNamedAndChangesTheMotion) {
  const Outcome usual = outcome("");
  ASSERT_GT(usual.hits, 100);
  for (const char* experiment : {"substeps=4", "warm_starting=0", "continuous=1", "mixes_friction=1"}) {
    const Outcome changed = outcome(experiment);
    EXPECT_GT(changed.hits, 100) << experiment;
    EXPECT_NE(changed.hash, usual.hash) << experiment;
    EXPECT_NE(changed.method, usual.method) << experiment;
  }
}

TEST(Experiments, TheThresholdOfReboundMeansNothingWithoutRestitution) {
  EXPECT_EQ(outcome("restitution_threshold_m_per_s=1").hash, outcome("").hash);
}

TEST(Experiments, OthersAreRefused) {
  for (const char* text : {"", "substeps", "substeps=0", "substeps=1.5", "continuous=2", "gravity=1", "substeps=nan"})
    EXPECT_THROW(box2d_options({text}), Error) << text;
}

}  // namespace
}  // namespace gem::baseline
