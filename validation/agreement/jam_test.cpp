// Threads, logging, blocks and restarts do not change a bit of a jam. Whether the bits are right is judged by the
// reference engine (reference_test.cpp) and, to the bit, by the cuda engine (cuda_jam_test.cpp).
#include "validation/agreement/jam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "gem/engine/cpu/cpu_engine.h"
#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/same_bits.h"

namespace gem {
namespace {

constexpr std::int64_t jam_steps = 40;

using Method = std::tuple<ContactSolver, Manifold>;

/// A state and its scene; every comparison starts from this state.
class JamTest : public testing::TestWithParam<Method> {
 protected:
  JamTest() {
    scene_ = agreement::jam_scene(std::get<0>(GetParam()));
    scene_.contact.manifold = std::get<1>(GetParam());
    field_ = agreement::drifting_field(scene_);
    start_ = agreement::jam(scene_, field_);
  }

  std::unique_ptr<Engine> engine_in_jam(const EngineOptions& options) const {
    auto engine = make_engine(scene_, field_, options);
    engine->restore(start_);
    return engine;
  }

  /// Hash after `count` time steps in blocks of `block`. Checks that every time step has enough contacts.
  std::uint64_t hash_after(Engine& engine, std::int64_t count = jam_steps, std::int64_t block = jam_steps,
                           bool events = true) {
    log_.clear();
    log_.wants_events = events;
    for (std::int64_t done = 0; done < count; done += block) engine.advance(std::min(block, count - done), log_);
    EXPECT_EQ(log_.quality.size(), static_cast<std::size_t>(count));
    for (const StepQuality& quality : log_.quality) EXPECT_GT(quality.contacts, agreement::contacts_wanted);
    return engine.state_hash();
  }

  SceneDef scene_;
  Bodies field_;
  EngineState start_;
  StepLog log_;
};

TEST_P(JamTest, ThePlatformFeelsTheSameWithAnyThreads) {
  std::vector<PlatformStep> first;
  for (const int threads : {1, 2, 3}) {
    hash_after(*engine_in_jam({"cpu", threads, 0}));
    if (first.empty()) first = log_.platform;
    ASSERT_EQ(log_.platform.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(log_.platform[i].ice_impulse.x, first[i].ice_impulse.x) << threads << " threads, time step " << i;
      EXPECT_EQ(log_.platform[i].ice_yaw_impulse, first[i].ice_yaw_impulse) << threads << " threads, time step " << i;
      EXPECT_EQ(log_.platform[i].contacts, first[i].contacts) << threads << " threads, time step " << i;
    }
  }
}

TEST_P(JamTest, TheBooksAreTheSameWithAnyThreads) {
  std::vector<Ledger> ledgers;
  for (const int threads : {1, 2, 3}) {
    const auto engine = engine_in_jam({"cpu", threads, 0});
    hash_after(*engine);
    ledgers.push_back(engine->ledger());
    test::expect_same_books(ledgers.back(), ledgers.front());
  }
  EXPECT_LT(ledgers.front()[Channel::impact].energy, start_.ledger[Channel::impact].energy);
}

TEST_P(JamTest, ThreadsChangeNothing) {
  constexpr std::int64_t few = 4;  // with more threads than processors every barrier is slow
  const std::uint64_t one = hash_after(*engine_in_jam(agreement::on("cpu", 1)), few);
  for (const int threads : {2, 3, 5, 8})
    EXPECT_EQ(hash_after(*engine_in_jam(agreement::on("cpu", threads)), few), one) << threads << " threads";
  // Here the iterations too are divided among threads, which pays only in larger jams.
  for (const int threads : {2, 3})
    EXPECT_EQ(hash_after(*engine_in_jam({"cpu", threads, 0}), few), one) << threads << " threads in every iteration";
}

TEST_P(JamTest, GoingOnWithFewerThreadsChangesNothing) {
  // long enough for the engine to try one thread, and to decide
  constexpr std::int64_t many = 120;
  const std::uint64_t one = hash_after(*engine_in_jam(agreement::on("cpu", 1)), many, many);
  const auto engine = engine_in_jam(agreement::on("cpu", 2));
  EXPECT_EQ(hash_after(*engine, many, many), one);
  EXPECT_GE(dynamic_cast<const CpuEngine&>(*engine).team_changes(), 1);
}

TEST_P(JamTest, LoggingAndBlocksChangeNothing) {
  const std::uint64_t whole = hash_after(*engine_in_jam(agreement::on("cpu")));
  const std::size_t platform_steps = log_.platform.size();
  EXPECT_EQ(hash_after(*engine_in_jam(agreement::on("cpu")), jam_steps, jam_steps, false), whole)
      << "events not logged";
  EXPECT_TRUE(log_.events.empty());
  for (const std::int64_t block : {1, 7}) {
    EXPECT_EQ(hash_after(*engine_in_jam(agreement::on("cpu")), jam_steps, block), whole) << "blocks of " << block;
    EXPECT_EQ(log_.platform.size(), platform_steps);
  }
}

TEST_P(JamTest, ARestartChangesNothing) {
  const std::uint64_t whole = hash_after(*engine_in_jam(agreement::on("cpu")));
  const auto before = engine_in_jam(agreement::on("cpu"));
  StepLog log;
  before->advance(jam_steps / 2, log);
  const EngineState half_way = before->save();
  const auto after = make_engine(scene_, field_, agreement::on("cpu"));
  after->restore(half_way);
  EXPECT_EQ(after->step(), start_.step + jam_steps / 2);
  after->advance(jam_steps / 2, log);
  EXPECT_EQ(after->state_hash(), whole);
  for (const StepQuality& quality : log.quality) EXPECT_GT(quality.contacts, agreement::contacts_wanted);
}

TEST_P(JamTest, OneFloeMovedByALittleChangesTheHash) {
  const std::uint64_t honest = hash_after(*engine_in_jam(agreement::on("cpu")));
  const std::size_t middle = field_.count() / 2;
  start_.bodies.position[middle].x += 1e-12;
  EXPECT_NE(hash_after(*engine_in_jam(agreement::on("cpu"))), honest);
}

INSTANTIATE_TEST_SUITE_P(Methods, JamTest,
                         testing::Combine(testing::Values(ContactSolver::independent, ContactSolver::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends)),
                         test::LawNames());

}  // namespace
}  // namespace gem
