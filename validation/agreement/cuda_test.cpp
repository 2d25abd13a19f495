// The cuda engine gives the bits of the cpu engine: every law, a jam, any layout on the GPU, any batch.
#include "gem/engine/cuda_engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <tuple>

#include "gem/base/error.h"
#include "gem/engine/same_bits.h"
#include "gem/engine/test_scenes.h"
#include "gem/scene/sweep.h"
#include "validation/agreement/jam.h"

namespace gem {
namespace {

/// Skips the test, with the reason, where no GPU answers.
class OnGpu : public testing::Test {
 protected:
  void SetUp() override {
    try {
      usable_cuda_device();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

SceneDef resolved(SceneDef scene, Resolution resolution, Manifold manifold) {
  scene.contact.resolution = resolution;
  scene.contact.manifold = manifold;
  return scene;
}

/// The named run of a sweep.
SceneDef member(const std::string& path, const std::string& name) {
  for (const SweepMember& run : expand_sweep(path))
    if (run.name == name) return run.scene;
  throw Error(ExitCode::usage, "no run " + name + " in " + path);
}

using Laws = std::tuple<Resolution, Manifold, Yaw, FrictionLaw, DragLaw>;

class CudaLaws : public OnGpu, public testing::WithParamInterface<Laws> {};

TEST_P(CudaLaws, GiveTheBitsOfTheCpu) {
  SceneDef scene = test::busy_scene(8);
  std::tie(scene.contact.resolution, scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law,
           scene.water.drag_law) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu"), cuda = test::busy_engine(scene, "cuda");
  MomentLog expected, log;
  for (int block = 0; block < 8; ++block) {
    cpu->advance(50, expected);
    cuda->advance(50, log);
    test::expect_same_bodies(cuda->bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    if (scene.contact.resolution == Resolution::coupled) test::expect_same_judgement(log, expected);
    if (HasFailure()) return;
  }
  EXPECT_EQ(cuda->state_hash(), cpu->state_hash());
  test::expect_same_books(cuda->ledger(), cpu->ledger());
  EXPECT_GT(test::contacts_in(expected), 5000);
  EXPECT_GT(expected.events.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Combinations, CudaLaws,
                         testing::Combine(testing::Values(Resolution::independent, Resolution::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic, DragLaw::linear, DragLaw::none)));

/// Laws of scenes that are moved by a launch for each phase.
class CudaPhases : public CudaLaws {};

TEST_P(CudaPhases, GiveTheBitsOfTheCpu) {
  SceneDef scene = test::busy_scene(8);
  std::tie(scene.contact.resolution, scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law,
           scene.water.drag_law) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  CudaBatch batch({{scene, test::busy_field(scene)}, {scene, test::busy_field(scene)}}, {.launches = Launches::phases});
  MomentLog expected;
  std::vector<MomentLog> logs(2);
  for (int call = 0; call < 8; ++call) {
    cpu->advance(50, expected);
    batch.advance(50, &logs);
  }
  EXPECT_EQ(batch.launches(), Launches::phases);
  for (const std::size_t k : {0, 1}) {
    test::expect_same_bodies(batch.bodies(k), cpu->bodies());
    test::expect_same_log(logs[k], expected);
    test::expect_same_books(batch.ledger(k), cpu->ledger());
    EXPECT_EQ(batch.state_hash(k), cpu->state_hash());
  }
  EXPECT_GT(test::contacts_in(expected), 5000);
  EXPECT_GT(expected.events.size(), 2u);
}

using CudaPhasesBriefly = OnGpu;

/// Few enough moments for compute-sanitizer's racecheck, amid contacts; two scenes share the device.
TEST_F(CudaPhasesBriefly, GiveTheBitsOfTheCpu) {
  for (const Resolution resolution : {Resolution::independent, Resolution::coupled}) {
    SceneDef scene = test::busy_scene(8);
    scene.contact.resolution = resolution;
    const auto cpu = test::busy_engine(scene, "cpu");
    MomentLog expected;
    cpu->advance(100, expected);
    const EngineState state = cpu->save();
    expected.clear();
    cpu->advance(3, expected);
    CudaBatch batch({{scene, test::busy_field(scene)}, {scene, test::busy_field(scene)}},
                    {.launches = Launches::phases});
    std::vector<MomentLog> logs(2);
    for (const std::size_t k : {0, 1}) batch.restore(k, state);
    batch.advance(3, &logs);
    EXPECT_EQ(batch.launches(), Launches::phases);
    for (const std::size_t k : {0, 1}) {
      EXPECT_EQ(batch.state_hash(k), cpu->state_hash());
      test::expect_same_log(logs[k], expected);
    }
    EXPECT_GT(test::contacts_in(expected), 100);
  }
}

TEST_F(OnGpu, RoundsOfATightResidualAreMadeToTheirEnd) {
  SceneDef scene = test::busy_scene(8);
  scene.numerics.residual_tolerance = 1e-9;
  scene.numerics.iterations_maximum = 200;
  const auto cpu = test::busy_engine(scene, "cpu");
  MomentLog expected;
  cpu->advance(40, expected);
  for (const Launches launches : {Launches::moments, Launches::phases}) {
    CudaBatch batch({{scene, test::busy_field(scene)}}, {.launches = launches});
    std::vector<MomentLog> logs(1);
    batch.advance(40, &logs);
    EXPECT_EQ(batch.launches(), launches);
    EXPECT_EQ(batch.state_hash(0), cpu->state_hash());
    test::expect_same_log(logs[0], expected);
    test::expect_same_judgement(logs[0], expected);
  }
  int longest = 0;
  for (const MomentQuality& quality : expected.quality) longest = std::max(longest, int(quality.iterations));
  EXPECT_GT(longest, 64) << "no moment took three rounds";
}

INSTANTIATE_TEST_SUITE_P(Combinations, CudaPhases,
                         testing::Combine(testing::Values(Resolution::independent, Resolution::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic, DragLaw::linear, DragLaw::none)));

using Way = std::tuple<Resolution, Manifold>;

/// The jam of 1,234 floes with what the cpu engine makes of it.
class CudaJam : public OnGpu, public testing::WithParamInterface<Way> {
 protected:
  static constexpr std::int64_t moments = 60;

  void SetUp() override {
    OnGpu::SetUp();
    if (IsSkipped()) return;
    const auto [resolution, manifold] = GetParam();
    scene_ = resolved(agreement::jam_scene(resolution), resolution, manifold);
    field_ = agreement::drifting_field(scene_);
    start_ = agreement::jam(scene_, field_);
    const auto cpu = make_engine(scene_, field_, agreement::on("cpu"));
    cpu->restore(start_);
    cpu->advance(moments, expected_);
    hash_ = cpu->state_hash();
    ledger_ = cpu->ledger();
    end_ = cpu->save();
    for (const MomentQuality& quality : expected_.quality) ASSERT_GT(quality.contacts, agreement::contacts_wanted);
  }

  std::vector<BatchScene> copies(std::size_t count) const { return std::vector<BatchScene>(count, {scene_, field_}); }

  SceneDef scene_;
  Bodies field_;
  EngineState start_;
  MomentLog expected_;
  std::uint64_t hash_ = 0;
  Ledger ledger_;
  EngineState end_;
};

TEST_P(CudaJam, NoLayoutOnTheGpuMatters) {
  for (const int blocks : {1, 2, 8, 16, 17, 36, 80, 112})
    for (const int threads : {32, 128, 256}) {
      CudaBatch batch(copies(1), {.blocks = blocks, .threads = threads, .ring_moments = 23});
      batch.restore(0, start_);
      std::vector<MomentLog> logs(1);
      batch.advance(moments, &logs);
      EXPECT_EQ(batch.state_hash(0), hash_) << blocks << " blocks of " << threads << " threads";
      test::expect_same_log(logs[0], expected_);
      if (scene_.contact.resolution == Resolution::coupled) test::expect_same_judgement(logs[0], expected_);
      test::expect_same_books(batch.ledger(0), ledger_);
      test::expect_same_memory(batch.save(0), end_);
    }
}

TEST_P(CudaJam, ThreadsThatNoBlockCanHaveAreRefused) {
  for (const int threads : {-32, 16, 48, 512})
    EXPECT_THROW(CudaBatch(copies(1), {.threads = threads}), Error) << threads << " threads";
}

TEST_P(CudaJam, AListTooSmallGrowsAndLosesNothing) {
  for (const Launches launches : {Launches::moments, Launches::phases}) {
    CudaBatch batch(copies(1), {.list_rows = 100, .launches = launches});
    batch.restore(0, start_);
    std::vector<MomentLog> logs(1);
    batch.advance(moments, &logs);
    EXPECT_EQ(batch.state_hash(0), hash_);
    test::expect_same_log(logs[0], expected_);
    if (scene_.contact.resolution == Resolution::coupled) test::expect_same_judgement(logs[0], expected_);
  }
}

/// As many as let the scenes be shared out among several streams, with a ring that holds few moments.
TEST_P(CudaJam, ManyScenesKeepTheirBitsPhaseByPhase) {
  constexpr std::size_t count = 120;
  CudaBatch batch(copies(count), {.ring_moments = 23});
  for (std::size_t k = 0; k < count; ++k) batch.restore(k, start_);
  std::vector<MomentLog> logs(count);
  std::vector<std::int64_t> some(count, moments);
  for (std::size_t k = 0; k < count; k += 15) some[k] = 7;
  batch.advance(some, &logs);
  EXPECT_EQ(batch.launches(), Launches::phases);
  for (std::int64_t& more : some) more = moments - more;
  batch.advance(some, &logs);
  EXPECT_EQ(batch.launches(), Launches::moments) << "those that are left in the end are few";
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_EQ(batch.state_hash(k), hash_) << "place " << k;
    test::expect_same_log(logs[k], expected_);
  }
  test::expect_same_books(batch.ledger(count - 1), ledger_);
}

TEST_P(CudaJam, WholeMomentsAndPhasesTakeTurns) {
  constexpr std::size_t count = 90;
  CudaBatch batch(copies(count), {});
  for (std::size_t k = 0; k < count; ++k) batch.restore(k, start_);
  std::vector<std::int64_t> alone(count, 0), all(count, 5);
  for (const std::size_t k : {0, 50}) alone[k] = 5;
  bool by_moments = false, by_phases = false;
  for (std::int64_t left = moments; left > 0; left -= 10) {
    batch.advance(alone, nullptr);
    by_moments |= batch.launches() == Launches::moments;
    batch.advance(all, nullptr);
    by_phases |= batch.launches() == Launches::phases;
  }
  EXPECT_TRUE(by_moments && by_phases);
  for (const std::size_t k : {0, 50}) EXPECT_EQ(batch.state_hash(k), hash_) << "place " << k;
}

TEST_P(CudaJam, ARestartChangesNothing) {
  for (const Launches launches : {Launches::moments, Launches::phases}) {
    const CudaOptions options{.launches = launches};
    auto engine = make_cuda_engine(scene_, field_, options);
    engine->restore(start_);
    MomentLog log;
    engine->advance(moments / 2, log);
    const EngineState half_way = engine->save();
    engine = make_cuda_engine(scene_, field_, options);
    engine->restore(half_way);
    engine->advance(moments - moments / 2, log);
    EXPECT_EQ(engine->state_hash(), hash_);
  }
}

TEST_P(CudaJam, ScenesOfABatchGoOnWithoutTheOthers) {
  CudaBatch batch(copies(3), {.ring_moments = 7});
  for (const std::size_t k : {0, 1, 2}) batch.restore(k, start_);
  batch.advance({moments / 2, moments, 0}, nullptr);
  EXPECT_EQ(batch.moment(2), start_.moment);
  EXPECT_EQ(batch.state_hash(1), hash_);
  batch.advance({moments - moments / 2, 0, moments}, nullptr);
  for (const std::size_t k : {0, 1, 2}) EXPECT_EQ(batch.state_hash(k), hash_) << "place " << k;
}

TEST_P(CudaJam, PlaceAndSizeOfABatchChangeNothing) {
  std::vector<BatchScene> scenes = copies(5);
  for (const std::size_t other : {0, 1, 3}) {
    scenes[other].scene = resolved(test::busy_scene(20 + other), std::get<0>(GetParam()), std::get<1>(GetParam()));
    scenes[other].bodies = test::busy_field(scenes[other].scene);
  }
  CudaBatch batch(scenes, {});
  for (const std::size_t jam : {2, 4}) batch.restore(jam, start_);
  batch.advance(moments, nullptr);
  for (const std::size_t jam : {2, 4}) EXPECT_EQ(batch.state_hash(jam), hash_) << "place " << jam;
  for (const std::size_t other : {0, 1, 3}) {
    const auto cpu = make_engine(scenes[other].scene, scenes[other].bodies, agreement::on("cpu"));
    MomentLog log;
    cpu->advance(moments, log);
    EXPECT_EQ(batch.state_hash(other), cpu->state_hash()) << "place " << other;
    EXPECT_GT(test::contacts_in(log), 100);
  }
}

TEST_P(CudaJam, ScenesThatShareTheDeviceUnequallyKeepTheirBits) {
  std::vector<BatchScene> scenes = copies(26);
  CudaBatch batch(scenes, {.ring_moments = 32, .launches = Launches::moments});
  std::vector<MomentsAhead> ahead;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    batch.restore(k, start_);
    // some have ten times as much before them as others, and later some stop at a frame of their own
    ahead.push_back({0, k % 3 == 0 ? 10 * moments : moments});
  }
  std::vector<MomentLog> logs(scenes.size());
  std::vector<std::size_t> places(scenes.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  const auto left = [&](std::size_t k) { return start_.moment + moments - batch.moment(k); };
  std::set<std::int64_t> first_moments;
  for (int calls = 0; std::any_of(places.begin(), places.end(), [&](std::size_t k) { return left(k) > 0; }); ++calls) {
    ASSERT_LT(calls, 1000);
    for (const std::size_t k : places)
      ahead[k].most = std::min<std::int64_t>(left(k), calls > 0 && k % 5 == 0 ? 3 : moments);
    for (const std::exception_ptr& fault : batch.advance_some(ahead, logs)) EXPECT_EQ(fault, nullptr);
    if (calls == 0)
      for (const std::size_t k : places) first_moments.insert(batch.moment(k));
  }
  EXPECT_GT(first_moments.size(), 1u) << "all went at one pace";
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    EXPECT_EQ(batch.state_hash(k), hash_) << "place " << k;
    test::expect_same_log(logs[k], expected_);
  }
}

/// Contraction changes bits. After one moment that is rounding, and with coupled contacts what rounding does to when
/// the iterations begin again; after sixty it is chaos (a strict run whose floes begin 1e-13 m elsewhere is 3 cm off),
/// so there only repetition, books and contacts are asked for.
TEST_P(CudaJam, FastKernelsAreCloseAndRepeatThemselves) {
  const bool coupled = scene_.contact.resolution == Resolution::coupled;
  const auto strict = make_engine(scene_, field_, agreement::on("cpu"));
  strict->restore(start_);
  MomentLog ignored;
  strict->advance(1, ignored);
  std::uint64_t hash = 0;
  for (int repetition = 0; repetition < 2; ++repetition) {
    CudaBatch batch(copies(2), {.arithmetic = Arithmetic::fast});
    for (const std::size_t k : {0, 1}) batch.restore(k, start_);
    std::vector<MomentLog> logs(2);
    batch.advance(1, &logs);
    EXPECT_LT(test::farthest_apart(batch.bodies(0), strict->bodies()), coupled ? 1e-6 : 1e-11);
    batch.advance(moments - 1, &logs);
    EXPECT_EQ(batch.state_hash(0), batch.state_hash(1));
    EXPECT_NE(batch.state_hash(0), hash_) << "nothing was contracted";
    if (repetition == 0) hash = batch.state_hash(0);
    EXPECT_EQ(batch.state_hash(0), hash);
    for (const MomentQuality& quality : logs[0].quality) EXPECT_GT(quality.contacts, agreement::contacts_wanted);
    const LedgerResidual left = residual(batch.ledger(0));
    EXPECT_LT(left.momentum, 1e-12);
    EXPECT_LT(left.energy, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, CudaJam,
                         testing::Combine(testing::Values(Resolution::independent, Resolution::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends)),
                         [](const auto& way) {
                           return std::string(std::get<0>(way.param) == Resolution::coupled ? "coupled"
                                                                                            : "independent") +
                                  (std::get<1>(way.param) == Manifold::chord_ends ? "_ends" : "_middle");
                         });

TEST_F(OnGpu, AStateThatIsNoNumberStopsTheRun) {
  const SceneDef scene = test::busy_scene(12);
  const auto engine = test::busy_engine(scene, "cuda");
  MomentLog log;
  engine->advance(3, log);
  EngineState state = engine->save();
  state.bodies.position[20].x = 1e308;
  state.bodies.velocity[20].x = -1e308;
  engine->restore(state);
  try {
    engine->advance(10, log);
    ADD_FAILURE() << "went on";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::numerical_stop) << error.what();
  }
}

class OneOfABatch : public OnGpu, public testing::WithParamInterface<Launches> {};

TEST_P(OneOfABatch, ThatFailsOnTheGpuStopsNoOther) {
  SceneDef scene = test::busy_scene(12);
  CudaBatch batch(std::vector<BatchScene>(4, {scene, test::busy_field(scene)}), {.launches = GetParam()});
  EngineState overflows = batch.save(0), no_number = overflows;
  overflows.bodies.position[20].x = 1e308;
  overflows.bodies.velocity[20].x = -1e308;
  no_number.bodies.velocity[20].x = std::numeric_limits<double>::quiet_NaN();
  batch.restore(1, overflows);
  batch.restore(2, no_number);
  std::vector<MomentLog> logs(4);
  const auto faults = batch.advance_some(std::vector<MomentsAhead>(4, {10, 10}), logs);
  EXPECT_TRUE(faults[1] && faults[2]);
  EXPECT_EQ(batch.moment(2), 0);
  const auto cpu = test::busy_engine(scene, "cpu");
  MomentLog log;
  cpu->advance(10, log);
  for (const std::size_t k : {0, 3}) {
    EXPECT_EQ(faults[k], nullptr) << "place " << k;
    EXPECT_EQ(batch.state_hash(k), cpu->state_hash()) << "place " << k;
    EXPECT_EQ(logs[k].platform.size(), 10u);
  }
}

INSTANTIATE_TEST_SUITE_P(OnGpuBy, OneOfABatch, testing::Values(Launches::moments, Launches::phases),
                         [](const auto& launches) {
                           return std::string(launches.param == Launches::phases ? "phases" : "moments");
                         });

class LongCuda : public OnGpu, public testing::WithParamInterface<Way> {};

/// One moment from each of 100 states along a run of the paper, and the whole of its first 600 s.
TEST_P(LongCuda, SixHundredSecondsOfTheDensestRun) {
  const auto [resolution, manifold] = GetParam();
  const SceneDef scene = resolved(member(GEM_SOURCE_DIR "/cases/table1.toml", "400_200_100"), resolution, manifold);
  const Bodies field = make_field(scene);
  const auto cpu = make_engine(scene, field, {"cpu", 0}), cuda = make_engine(scene, field, agreement::on("cuda"));
  const auto probe = make_engine(scene, field, agreement::on("cuda"));
  const std::int64_t stretch = std::llround(6.0 / scene.numerics.moment_s);
  std::int64_t contacts = 0;
  for (int block = 0; block < 100; ++block) {
    MomentLog expected, log;
    const EngineState state = cpu->save();
    cpu->advance(1, expected);
    probe->restore(state);
    probe->advance(1, log);
    ASSERT_EQ(probe->state_hash(), cpu->state_hash()) << "moment " << cpu->moment();
    cpu->advance(stretch - 1, expected);
    log.clear();
    cuda->advance(stretch, log);
    ASSERT_EQ(cuda->state_hash(), cpu->state_hash()) << "moment " << cpu->moment();
    test::expect_same_log(log, expected);
    if (resolution == Resolution::coupled) test::expect_same_judgement(log, expected);
    if (HasFailure()) return;
    contacts += test::contacts_in(expected);
  }
  test::expect_same_books(cuda->ledger(), cpu->ledger());
  EXPECT_GT(contacts, 1000000);
}

INSTANTIATE_TEST_SUITE_P(Ways, LongCuda,
                         testing::Values(Way{Resolution::independent, Manifold::chord_middle},
                                         Way{Resolution::coupled, Manifold::chord_ends}));

}  // namespace
}  // namespace gem
