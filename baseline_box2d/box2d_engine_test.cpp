// The engine box2d: drag and mooring equal gem's to the bit; Box2D's contacts, books, restart and command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "baseline_box2d/register_box2d.h"
#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/field/field.h"

namespace gem::baseline {
namespace {

/// Relative spacing of floats near 1. All speeds in these scenes are below 1 m/s.
constexpr double float_step = 0x1p-23;

[[maybe_unused]] const bool registered = [] {
  register_box2d();
  return true;
}();

EngineOptions on(const std::string& name) {
  EngineOptions options;
  options.name = name;
  return options;
}

SceneDef still_scene() {
  SceneDef scene;
  scene.contact.solver = ContactSolver::coupled;
  scene.current.velocity_m_per_s = {0.0, 0.0};
  scene.water.drag_law = DragLaw::none;
  scene.ice.friction_ice = scene.ice.friction_structure = 0.0;
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = scene.platform.present = false;
  return scene;
}

FloeDef square(double side, Vec2 position, Vec2 velocity) {
  const double h = 0.5 * side;
  return {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}, position, 0.0, velocity, 0.0, 0.5};
}

std::int64_t contacts_of(const StepLog& log) { return test::contacts_in(log); }

TEST(Box2dEngine, IsABaselineAndNoGemEngine) {
  const auto names = engine_names(), baselines = baseline_names();
  EXPECT_EQ(std::count(names.begin(), names.end(), "box2d"), 0);
  EXPECT_EQ(std::count(baselines.begin(), baselines.end(), "box2d"), 1);
  EXPECT_THROW(make_engine(still_scene(), {}, on("box3d")), Error);
}

TEST(Box2dEngine, BadOptionsAreRefused) {
  SceneDef scene = still_scene();
  scene.floe = {square(10.0, {}, {})};
  const Bodies field = make_field(scene);
  for (const char* setting : {"velocity_iterations=0", "position_iterations=-1", "skin_m=nan", "gravity=1"}) {
    EngineOptions options = on("box2d");
    options.baseline_settings = {setting};
    EXPECT_THROW(make_engine(scene, field, options), Error) << setting;
  }
}

TEST(Box2dEngine, RefusesATimeStepInWhichBodiesOverlapUnseen) {
  SceneDef scene = still_scene();
  scene.floe = {square(2.0, {}, {0.5, 0.0}), square(2.0, {4.0, 0.0}, {-0.5, 0.0})};
  const Bodies field = make_field(scene);
  scene.numerics.time_step_s = 0.2;
  EXPECT_NO_THROW(make_engine(scene, field, on("box2d")));
  scene.numerics.time_step_s = 0.21;
  EXPECT_NO_THROW(make_engine(scene, field, on("cpu")));
  EXPECT_THROW(make_engine(scene, field, on("box2d")), Error);
}

TEST(Box2dEngine, V04_flatOnAWall) {
  SceneDef scene = still_scene();
  scene.fixed = {{{{-64.0, -16.0}, {64.0, -16.0}, {64.0, 0.0}, {-64.0, 0.0}}}};
  scene.floe = {square(10.0, {0.0, 5.0}, {0.0, -0.5})};
  const auto engine = make_engine(scene, make_field(scene), on("box2d"));
  StepLog log;
  engine->advance(1, log);
  ASSERT_GT(contacts_of(log), 0);
  const Bodies& b = engine->bodies();
  // Both corners are solved together, so the error is a few roundings of 0.5 m/s.
  EXPECT_NEAR(b.velocity[2].y, 0.0, 4.0 * 0.5 * float_step);
  EXPECT_NEAR(b.spin[2], 0.0, 4.0 * 0.1 * float_step);
  const Ledger books = engine->ledger();
  EXPECT_NEAR(books[Channel::impact].momentum.y, 22500.0, 8.0 * 22500.0 * float_step);
  EXPECT_NEAR(-books[Channel::impact].energy, 5625.0, 8.0 * 5625.0 * float_step);
}

TEST(Box2dEngine, V05_twoFloesHeadOn) {
  SceneDef scene = still_scene();
  scene.floe = {square(10.0, {0.0, 0.0}, {0.6, 0.0}), square(6.0, {8.0, 0.0}, {-0.2, 0.0})};
  const auto engine = make_engine(scene, make_field(scene), on("box2d"));
  StepLog log;
  engine->advance(1, log);
  ASSERT_GT(contacts_of(log), 0);
  const double together = 0.388235294118, loss = 3811.76470588;
  for (const std::size_t i : {1u, 2u})
    EXPECT_NEAR(engine->bodies().velocity[i].x, together, 4.0 * 0.8 * float_step) << i;
  EXPECT_NEAR(-engine->ledger()[Channel::impact].energy, loss, 1e4 * 8.0 * float_step);
  EXPECT_LT(residual(engine->ledger()).momentum, 8.0 * float_step);
}

TEST(Box2dEngine, FrictionIsThatOfThePair) {
  // The floe is pressed on at 0.5 m/s and slides: the impulse along the face is mu times the normal one, against the
  // slip.
  for (const bool on_platform : {false, true}) {
    SceneDef scene = still_scene();
    scene.ice.friction_ice = 0.35;
    scene.ice.friction_structure = 0.1;
    scene.floe = {square(10.0, {0.0, 5.0}, {0.4, -0.1})};
    if (on_platform) {
      scene.platform.present = true;  // a corner of the 20-gon points up at the middle of the floe's face
      scene.platform.anchor_m = {0.0, -50.0};
    } else {
      scene.fixed = {{{{-64.0, -16.0}, {64.0, -16.0}, {64.0, 0.0}, {-64.0, 0.0}}}};
    }
    const auto engine = make_engine(scene, make_field(scene), on("box2d"));
    const Bodies before = engine->bodies();
    StepLog log;
    engine->advance(1, log);
    ASSERT_GT(contacts_of(log), 0) << on_platform;
    const std::size_t floe = before.count() - 1;
    const Vec2 given = before.mass[floe] * (engine->bodies().velocity[floe] - before.velocity[floe]);
    ASSERT_GT(given.y, 0.0);
    const double mu = on_platform ? 0.1 : 0.35;
    EXPECT_NEAR(-given.x / given.y, mu, 64.0 * float_step) << on_platform;
    if (on_platform) {
      ASSERT_EQ(log.events.size(), 1u);
      const ContactEvent& e = log.events[0];
      EXPECT_EQ(e.body_b, 1);
      EXPECT_NEAR(e.normal.y, 1.0, 1e-6);
      EXPECT_NEAR(e.impulse_normal, given.y, 1e-5 * given.y);
      EXPECT_NEAR(e.impulse_tangential, -given.x, 1e-5 * given.y);  // along the normal turned left
      EXPECT_NEAR(e.closing_speed, 0.1, 1e-6);
      EXPECT_GT(e.peak_force, 0.0);
    }
  }
}

TEST(Box2dEngine, DragOfFreeFloesIsGemsToTheBit) {
  SceneDef scene = still_scene();
  scene.current.velocity_m_per_s = {0.5, 0.1};
  scene.water.drag_law = DragLaw::quadratic;
  scene.floe = {square(10.0, {0.0, 0.0}, {}), square(6.0, {30.0, 0.0}, {-0.2, 0.3})};
  scene.floe[1].spin_rad_per_s = 0.02;
  const auto gems = make_engine(scene, make_field(scene), on("cpu"));
  const auto box2d = make_engine(scene, make_field(scene), on("box2d"));
  StepLog log;
  for (int k = 0; k < 10; ++k) {
    gems->advance(100, log);
    box2d->advance(100, log);
    for (const std::size_t i : {1u, 2u}) {
      EXPECT_EQ(box2d->bodies().velocity[i].x, gems->bodies().velocity[i].x);
      EXPECT_EQ(box2d->bodies().velocity[i].y, gems->bodies().velocity[i].y);
      EXPECT_EQ(box2d->bodies().spin[i], gems->bodies().spin[i]);
    }
  }
  EXPECT_EQ(contacts_of(log), 0);
  // Positions are floats: 2e-6 m of rounding per time step at 32 m. They also lag by half of one time step's
  // acceleration, 0.5 U dt.
  const Vec2 off = box2d->bodies().position[1] - gems->bodies().position[1];
  EXPECT_LT(length(off), 1000 * 2e-6 + 0.5 * 0.51 * 0.05);
  EXPECT_EQ(residual(box2d->ledger()).energy, residual(gems->ledger()).energy);
}

TEST(Box2dEngine, V39_swingIsGemsToTheBit) {
  SceneDef scene = still_scene();
  scene.platform.present = true;
  scene.platform.start_offset_m = {1.0, 0.0};
  scene.platform_drag.present = true;
  scene.mooring.damping_ratio = 0.01;
  const auto gems = make_engine(scene, make_field(scene), on("cpu"));
  const auto box2d = make_engine(scene, make_field(scene), on("box2d"));
  StepLog log;
  gems->advance(2000, log);
  box2d->advance(2000, log);
  EXPECT_EQ(box2d->state_hash(), gems->state_hash());
  EXPECT_LT(box2d->bodies().position[0].x, 0.99);
}

TEST(Box2dEngine, DragByAxisIsGemsToTheBit) {
  SceneDef scene = still_scene();
  scene.platform.present = true;
  scene.platform.outline = PlatformOutline::ship;
  scene.platform.start_velocity_m_per_s = {0.5, 1.0};
  scene.platform.start_spin_rad_per_s = 0.01;
  scene.platform_drag = {.present = true, .law = PlatformDragLaw::by_axis};
  const auto gems = make_engine(scene, make_field(scene), on("cpu"));
  const auto box2d = make_engine(scene, make_field(scene), on("box2d"));
  StepLog log;
  gems->advance(2000, log);
  box2d->advance(2000, log);
  EXPECT_EQ(box2d->state_hash(), gems->state_hash());
  EXPECT_LT(box2d->bodies().spin[0], 0.009);
}

TEST(Box2dEngine, V33_columnOnAWall) {
  SceneDef scene = still_scene();
  scene.current.velocity_m_per_s = {0.5, 0.0};
  scene.water.drag_law = DragLaw::quadratic;
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = 0.05 * 900.0 * 0.5 / 1025.0;  // k = 0.05 1/m
  const int count = 5;
  for (int i = 0; i < count; ++i) scene.floe.push_back(square(10.0, {5.0 + 10.0 * i, 0.0}, {}));
  const double end = 10.0 * count;
  scene.fixed = {{{{end, -20.0}, {end + 10.0, -20.0}, {end + 10.0, 20.0}, {end, 20.0}}}};
  const auto engine = make_engine(scene, make_field(scene), on("box2d"));
  StepLog log;
  engine->advance(600, log);
  const double before = engine->ledger()[Channel::impact].momentum.x;
  log.clear();  // the row began with overlapping skins and was pushed apart
  engine->advance(200, log);
  ASSERT_GT(contacts_of(log), 0);
  const double force = (before - engine->ledger()[Channel::impact].momentum.x) / (200 * 0.05);
  // Within a time step a floe yields to the current, which reduces its drag by the factor 1 + k U dt. The rest is
  // Box2D's rounding.
  const double held = count * 562.5 / (1.0 + 0.05 * 0.5 * 0.05);
  EXPECT_NEAR(force, held, 1e-5 * held);
  for (const StepQuality& q : log.quality) EXPECT_LT(count * q.maximum_overlap, 1e-3);
}

TEST(Box2dEngine, SameRunTwiceGivesTheSameBits) {
  const SceneDef scene = test::busy_scene(15);
  std::array<std::uint64_t, 2> hash{};
  for (std::uint64_t& h : hash) {
    const auto engine = make_engine(scene, test::busy_field(scene), on("box2d"));
    StepLog log;
    engine->advance(400, log);
    EXPECT_GT(contacts_of(log), 1000);
    h = engine->state_hash();
  }
  EXPECT_EQ(hash[0], hash[1]);
}

TEST(Box2dEngine, IceForceIsWhatMovesThePlatformAndBooksCloseInFloat) {
  SceneDef scene = test::busy_scene(15);
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.platform_drag.present = false;
  const auto engine = make_engine(scene, test::busy_field(scene), on("box2d"));
  const Bodies start = engine->bodies();
  StepLog log;
  engine->advance(400, log);
  Vec2 impulse;
  double yaw = 0.0;
  std::int64_t hits = 0;
  for (const PlatformStep& p : log.platform) {
    impulse += p.ice_impulse;
    yaw += p.ice_yaw_impulse;
    hits += p.contacts;
  }
  ASSERT_GT(hits, 100);
  EXPECT_GT(log.events.size(), 0u);
  const Vec2 gained = start.mass[0] * (engine->bodies().velocity[0] - start.velocity[0]);
  EXPECT_NEAR(length(gained - impulse), 0.0, 1e-9 * length(gained));
  EXPECT_NEAR(start.inertia[0] * (engine->bodies().spin[0] - start.spin[0]), yaw, 1e-9 * std::fabs(yaw));
  const LedgerResidual left = residual(engine->ledger());
  // The floes and the platform's books differ by Box2D's rounding of every contact in every time step.
  EXPECT_LT(left.momentum, 400.0 * float_step);
  EXPECT_LT(left.energy, 400.0 * float_step);
  EXPECT_GT(left.momentum, 0.0);
}

TEST(Box2dEngine, ASteeredShipAndAFixedOneAreMirrored) {
  for (const bool fixed : {false, true}) {
    const SceneDef scene = test::ship_scene(3, fixed);
    const Bodies start = test::busy_field(scene);
    const auto engine = make_engine(scene, start, on("box2d"));
    StepLog log;
    engine->advance(300, log);
    Vec2 ice, ground;
    for (const PlatformStep& step : log.platform) ice += step.ice_impulse, ground += step.mooring_impulse;
    EXPECT_GT(length(ice), 1e4);
    const Bodies& b = engine->bodies();
    EXPECT_EQ(b.position[0].x == start.position[0].x && b.position[0].y == start.position[0].y, fixed);
    EXPECT_EQ(b.rotation[0].sine == start.rotation[0].sine, fixed);
    if (fixed) {
      EXPECT_LE(length(ice + ground), 1e-12 * length(ice)) << "the ground takes what the ice gives";
    }
  }
}

TEST(Box2dEngine, RestoredStateIsTheSameStateWithoutItsWarmStart) {
  const SceneDef scene = test::busy_scene(15);
  const auto engine = make_engine(scene, test::busy_field(scene), on("box2d"));
  StepLog log;
  engine->advance(200, log);
  const EngineState state = engine->save();
  EXPECT_TRUE(state.impulse_key.empty());
  const auto again = make_engine(scene, test::busy_field(scene), on("box2d"));
  again->restore(state);
  EXPECT_EQ(again->step(), 200);
  EXPECT_EQ(again->state_hash(), engine->state_hash());
  const LedgerResidual one = residual(again->ledger()), other = residual(engine->ledger());
  EXPECT_EQ(one.energy, other.energy);
  // Without the last impulses the next step starts from zero: the result is close, not equal.
  log.clear();
  engine->advance(1, log);
  again->advance(1, log);
  ASSERT_GT(contacts_of(log), 0);
  double farthest = 0.0;
  for (std::size_t i = 0; i < state.bodies.count(); ++i)
    farthest = std::max(farthest, length(engine->bodies().velocity[i] - again->bodies().velocity[i]));
  EXPECT_LT(farthest, 0.1);
}

TEST(Box2dEngine, WithoutMeasuringTheMotionIsTheSame) {
  const SceneDef scene = test::busy_scene(15);
  const auto measured = make_engine(scene, test::busy_field(scene), on("box2d"));
  EngineOptions options = on("box2d");
  options.baseline_settings = {"measures_quality=0"};
  const auto bare = make_engine(scene, test::busy_field(scene), options);
  StepLog log;
  measured->advance(200, log);
  EXPECT_GT(contacts_of(log), 0);
  EXPECT_FALSE(std::isnan(log.quality.back().maximum_overlap));
  log.clear();
  bare->advance(200, log);
  EXPECT_TRUE(std::isnan(log.quality.back().maximum_overlap));
  EXPECT_EQ(measured->state_hash(), bare->state_hash());
}

TEST(Box2dEngine, RunsFromTheCommandLine) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "run.h5";
  const std::string command =
      std::string(GEM_PROGRAM) + " run " + GEM_SOURCE_DIR +
      "/cases/analytic/V10_floe_on_moored_platform.toml --engine box2d --set contact.solver=coupled --until 5 -q "
      "--velocity-iterations 20 --position-iterations 10 --skin 0.01 --overwrite -o " +
      file.string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_GT(std::filesystem::file_size(file), 1000u);
  const std::string info = std::string(GEM_PROGRAM) + " info " + file.string();
  FILE* pipe = popen(info.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string text;
  std::array<char, 256> buffer;
  while (fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  pclose(pipe);
  EXPECT_NE(text.find("box2d"), std::string::npos) << text;
}

}  // namespace
}  // namespace gem::baseline
