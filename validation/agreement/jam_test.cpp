// Engines agree bit for bit on a jam, and nothing that should not matter does: threads, logging, blocks, restarts.
#include "validation/agreement/jam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace gem {
namespace {

constexpr std::int64_t steps = 40;

using Method = std::tuple<ContactSolver, Manifold>;

/// A state with its scene; each comparison starts anew from it.
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

  /// Hash after `count` time steps in blocks of `block`; the log is checked to be dense in contacts.
  std::uint64_t hash_after(Engine& engine, std::int64_t count = steps, std::int64_t block = steps, bool events = true) {
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

TEST_P(JamTest, AllEnginesGiveTheSameBits) {
  std::vector<std::uint64_t> hashes;
  std::vector<PlatformStep> first;
  for (const std::string& name : engine_names()) {
    const auto engine = engine_in_jam(agreement::on(name));
    hashes.push_back(hash_after(*engine));
    EXPECT_EQ(hashes.back(), hashes.front()) << name;
    if (first.empty()) first = log_.platform;
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(log_.platform[i].ice_impulse.x, first[i].ice_impulse.x) << name << " time step " << i;
      EXPECT_EQ(log_.platform[i].ice_yaw_impulse, first[i].ice_yaw_impulse) << name << " time step " << i;
      EXPECT_EQ(log_.platform[i].contacts, first[i].contacts) << name << " time step " << i;
    }
  }
  EXPECT_GE(hashes.size(), 2u);
}

TEST_P(JamTest, AllEnginesKeepTheSameBooks) {
  std::vector<Ledger> ledgers;
  for (const std::string& name : engine_names()) {
    const auto engine = engine_in_jam(agreement::on(name));
    hash_after(*engine);
    ledgers.push_back(engine->ledger());
    for (std::size_t c = 0; c < ledgers.front().channel.size(); ++c) {
      const Quantity &first = ledgers.front().channel[c], &now = ledgers.back().channel[c];
      EXPECT_EQ(now.momentum.x, first.momentum.x) << name << " " << channel_name(Channel(c));
      EXPECT_EQ(now.momentum.y, first.momentum.y) << name << " " << channel_name(Channel(c));
      EXPECT_EQ(now.angular_momentum, first.angular_momentum) << name << " " << channel_name(Channel(c));
      EXPECT_EQ(now.energy, first.energy) << name << " " << channel_name(Channel(c));
    }
    EXPECT_EQ(ledgers.back().mooring_force.momentum.x, ledgers.front().mooring_force.momentum.x) << name;
    EXPECT_EQ(ledgers.back().mooring_force.angular_momentum, ledgers.front().mooring_force.angular_momentum) << name;
    EXPECT_EQ(ledgers.back().now.energy, ledgers.front().now.energy) << name;
  }
  EXPECT_LT(ledgers.front()[Channel::impact].energy, start_.ledger[Channel::impact].energy);
}

TEST_P(JamTest, ThreadsChangeNothing) {
  constexpr std::int64_t few = 4;  // more threads than processors wait for each other at every barrier
  const std::uint64_t one = hash_after(*engine_in_jam(agreement::on("cpu", 1)), few);
  for (const int threads : {2, 3, 5, 8})
    EXPECT_EQ(hash_after(*engine_in_jam(agreement::on("cpu", threads)), few), one) << threads << " threads";
  // the sweeps too shared out, which pays only in larger jams
  for (const int threads : {2, 3})
    EXPECT_EQ(hash_after(*engine_in_jam({"cpu", threads, 0}), few), one) << threads << " threads in every sweep";
}

TEST_P(JamTest, GoingOnWithFewerThreadsChangesNothing) {
  // long enough for the engine to have tried one thread and all
  constexpr std::int64_t many = 120;
  const std::uint64_t one = hash_after(*engine_in_jam(agreement::on("cpu", 1)), many, many);
  EXPECT_EQ(hash_after(*engine_in_jam(agreement::on("cpu", 2)), many, many), one);
}

TEST_P(JamTest, LoggingAndBlocksChangeNothing) {
  const std::uint64_t whole = hash_after(*engine_in_jam(agreement::on("cpu")));
  const std::size_t platform_steps = log_.platform.size();
  EXPECT_EQ(hash_after(*engine_in_jam(agreement::on("cpu")), steps, steps, false), whole) << "events not logged";
  EXPECT_TRUE(log_.events.empty());
  for (const std::int64_t block : {1, 7}) {
    EXPECT_EQ(hash_after(*engine_in_jam(agreement::on("cpu")), steps, block), whole) << "blocks of " << block;
    EXPECT_EQ(log_.platform.size(), platform_steps);
  }
}

TEST_P(JamTest, ARestartChangesNothing) {
  for (const std::string& name : engine_names()) {
    const std::uint64_t whole = hash_after(*engine_in_jam(agreement::on(name)));
    const auto before = engine_in_jam(agreement::on(name));
    StepLog log;
    before->advance(steps / 2, log);
    const EngineState half_way = before->save();
    const auto after = make_engine(scene_, field_, agreement::on(name));
    after->restore(half_way);
    EXPECT_EQ(after->step(), start_.step + steps / 2);
    after->advance(steps / 2, log);
    EXPECT_EQ(after->state_hash(), whole) << name;
    for (const StepQuality& quality : log.quality) EXPECT_GT(quality.contacts, agreement::contacts_wanted);
  }
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
                         [](const auto& method) {
                           const bool coupled = std::get<0>(method.param) == ContactSolver::coupled;
                           const bool ends = std::get<1>(method.param) == Manifold::chord_ends;
                           return std::string(coupled ? "coupled" : "independent") + (ends ? "_ends" : "_middle");
                         });

}  // namespace
}  // namespace gem
