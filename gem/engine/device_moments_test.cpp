// The device's recipe, run by one host thread, gives the bits, the books and the log of the cpu engine.
#include "gem/engine/device_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <tuple>

#include "gem/engine/books.h"
#include "gem/engine/same_bits.h"
#include "gem/engine/scene_image.h"
#include "gem/engine/team_crew.h"
#include "gem/engine/test_scenes.h"

namespace gem {
namespace {

/// A device scene in the memory of the host.
class HostScene {
 public:
  HostScene(const SceneDef& scene, const Bodies& bodies, int blocks = 1, int threads = 1, std::int32_t rows = 0,
            std::size_t room = 1 << 20, bool apart = false)
      : field_(make_field_state(bodies, moment_constants(scene, bodies))),
        sizes_(scene_sizes(field_)),
        scene_(scene_constants(field_, scene.output.event_speed_m_per_s)),
        threads_(threads),
        room_(room),
        apart_(apart) {
    sizes_.blocks = blocks;
    if (rows > 0) sizes_.rows = rows;
    sizes_.samples = 32;
    scene_.wants_events = scene_.wants_samples = 1;
    memory_[0].resize(place_field(scene_, sizes_, nullptr));
    place_field(scene_, sizes_, memory_[0].data());
    memory_[2].resize(place_rings(scene_, sizes_, nullptr));
    place_rings(scene_, sizes_, memory_[2].data());
    grow();
    write_field(field_, 0, scene_);
  }

  void advance(std::int64_t moments, MomentLog& log) {
    while (moments > 0) {
      const std::int32_t some = static_cast<std::int32_t>(std::min<std::int64_t>(moments, sizes_.samples));
      if (sizes_.blocks == 1 && threads_ == 1) {
        SoloCrew crew;
        advance_scene(scene_, crew, some);
      } else {
        const auto move = [&](auto& crew) { advance_scene(scene_, crew, some); };
        if (apart_)
          test::run_team<test::ApartCrew>(sizes_.blocks, threads_, room_, move);
        else
          test::run_team<test::TeamCrew>(sizes_.blocks, threads_, room_, move);
      }
      const DeviceStatus& status = *scene_.status;
      append_log(field_, scene_, status, sizes_.blocks, log);
      moments -= status.samples;
      if (status.stop == DeviceStop::list_full) {
        sizes_.rows = std::max(sizes_.rows, status.rows_needed);
        sizes_.platform_rows = std::max(sizes_.platform_rows, status.platform_needed);
        const std::vector<CarriedMemory> carried = memory();
        grow();
        std::copy(carried.begin(), carried.end(), scene_.carried);
        ++growths_;
      }
      if (status.stop == DeviceStop::not_finite) break;
    }
    read_state(scene_.state, field_);
  }

  /// What a batch does with a scene that is done while others are not.
  void wait() {
    SoloCrew crew;
    advance_scene(scene_, crew, 0);
  }

  Ledger ledger(const Ledger& start) {
    Ledger running;
    running.start = start.start;
    field_.books.assign(scene_.books, scene_.books + field_.books.size());
    field_.mooring_force = scene_.platform->mooring_force;
    return closed_books(field_, running);
  }

  std::vector<CarriedMemory> memory() const { return {scene_.carried, scene_.carried + scene_.status->carried}; }

  const Bodies& bodies() const { return field_.bodies; }
  const DeviceStatus& status() const { return *scene_.status; }
  int growths() const { return growths_; }
  std::int32_t longest_lower_row() const {
    std::int32_t longest = 0;
    for (std::int32_t i = 0; i < scene_.bodies; ++i) longest = std::max(longest, scene_.motion[i].lower_count);
    return longest;
  }

 private:
  void grow() {
    memory_[1].resize(place_list(scene_, sizes_, nullptr));
    std::memset(memory_[1].data(), 0xff, memory_[1].size());
    place_list(scene_, sizes_, memory_[1].data());
  }

  FieldState field_;
  SceneSizes sizes_;
  DeviceScene scene_;
  int threads_;
  std::size_t room_;
  bool apart_;
  std::vector<std::byte> memory_[3];
  int growths_ = 0;
};

using Choice = std::tuple<Resolution, Manifold, Yaw, FrictionLaw, DragLaw>;

class DeviceMomentsTest : public testing::TestWithParam<Choice> {};

TEST_P(DeviceMomentsTest, GivesTheBitsOfTheCpuEngine) {
  SceneDef scene = test::busy_scene(8);
  std::tie(scene.contact.resolution, scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law,
           scene.water.drag_law) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device(scene, test::busy_field(scene));
  MomentLog expected, log;
  for (int block = 0; block < 8; ++block) {
    cpu->advance(50, expected);
    device.advance(50, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    if (HasFailure()) return;
  }
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  if (scene.contact.resolution == Resolution::coupled) {
    EngineState state;
    save_memory(device.memory(), state);
    test::expect_same_memory(state, cpu->save());
    test::expect_same_judgement(log, expected);
    EXPECT_GT(state.impulse_key.size(), 20u);
  } else {
    MomentQuality worst;
    for (const MomentQuality& quality : log.quality) worst.worsen(quality);
    // not measured is no zero
    EXPECT_TRUE(std::isnan(worst.complementarity) && std::isnan(worst.cone_excess) && std::isnan(worst.energy_created));
    EXPECT_GT(worst.maximum_overlap, 0.0);
  }
  EXPECT_GT(test::contacts_in(expected), 5000);
  EXPECT_GT(expected.events.size(), 2u);
  EXPECT_GT(device.status().builds, 3);
}

INSTANTIATE_TEST_SUITE_P(Combinations, DeviceMomentsTest,
                         testing::Combine(testing::Values(Resolution::independent, Resolution::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic, DragLaw::linear, DragLaw::none)));

class DeviceResolutions : public testing::TestWithParam<Resolution> {};

TEST(PairMemory, OfAPairThatIsNewHoldsNothingInAnyMoment) {
  PairMemory memory;
  memory.feature[0] = 3;  // what an earlier list left there
  memory.impulse[0] = {1.0, 2.0, 3.0};
  for (const std::int32_t moment : {0, 1, 1000}) EXPECT_EQ(last_impulse(memory, 3, moment).normal, 0.0) << moment;
  memory.moment = 999;
  EXPECT_EQ(last_impulse(memory, 3, 1000).normal, 1.0);
}

TEST_P(DeviceResolutions, BlocksAndThreadsChangeNothing) {
  constexpr std::int64_t moments = 12;  // threads that outnumber the processors wait long at every barrier
  SceneDef scene = test::busy_scene(7);
  scene.contact.resolution = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  MomentLog expected;
  cpu->advance(moments, expected);
  EXPECT_GT(test::contacts_in(expected), 50);
  const std::size_t none = desk_minimum(8, test::team_lanes), bodies = none + 160 * 256, all = 1 << 20;
  for (const auto& [blocks, threads, room, apart] :
       {std::tuple{1, 8, none, false}, {2, 4, bodies, false}, {3, 4, all, false}, {2, 8, all, true}}) {
    HostScene device(scene, test::busy_field(scene), blocks, threads, 0, room, apart);
    MomentLog log;
    device.advance(moments, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
    EXPECT_GT(device.status().builds, 0);
  }
}

/// Floes at the platform and rows of more places than one stretch of a row or the first near bodies take.
TEST_P(DeviceResolutions, LongRowsAndThePlatformByManyThreadsChangeNothing) {
  constexpr std::int64_t moments = 6;
  SceneDef scene = test::busy_scene(8);
  scene.contact.resolution = GetParam();
  scene.numerics.list_margin_m = 60.0;
  const auto before = test::busy_engine(scene, "cpu");
  const auto at_platform = [](const MomentLog& log) {
    std::int64_t floes = 0;
    for (const PlatformMoment& sample : log.platform) floes += sample.contacts;
    return floes;
  };
  for (MomentLog skipped; at_platform(skipped) < 5 && before->moment() < 3000;) {
    skipped.clear();
    before->advance(5, skipped);
  }
  const Bodies field = before->bodies();
  const auto cpu = make_engine(scene, field, {"cpu", 1});
  MomentLog expected;
  cpu->advance(moments, expected);
  EXPECT_GT(at_platform(expected), 5);
  const std::size_t all = 1 << 20;
  for (const auto& [blocks, threads, apart] : {std::tuple{2, 8, false}, {2, 8, true}}) {
    HostScene device(scene, field, blocks, threads, 0, all, apart);
    MomentLog log;
    device.advance(moments, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
    EXPECT_GT(device.longest_lower_row(), RowNews::stretch);
  }
}

TEST_P(DeviceResolutions, AHorizonFollowsTheLifeOfListsInShortCallsToo) {
  SceneDef scene = test::busy_scene(6);
  scene.contact.resolution = GetParam();
  HostScene device(scene, test::busy_field(scene));
  const std::int64_t longest = device.status().horizon;
  MomentLog log;
  std::int64_t least = longest;
  for (int call = 0; call < 400; ++call) {
    device.advance(1, log);
    least = std::min(least, device.status().horizon);
  }
  EXPECT_GE(least, 4);
  EXPECT_LT(least, longest);
}

TEST_P(DeviceResolutions, AListTooSmallGrowsAndLosesNothing) {
  SceneDef scene = test::busy_scene(6);
  scene.contact.resolution = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device(scene, test::busy_field(scene), 1, 1, 64);
  MomentLog expected, log;
  cpu->advance(200, expected);
  device.advance(200, log);
  EXPECT_GT(device.growths(), 0);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  EXPECT_GT(test::contacts_in(expected), 2000);
}

TEST_P(DeviceResolutions, WaitingForOtherScenesChangesNothing) {
  SceneDef scene = test::busy_scene(6);
  scene.contact.resolution = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device(scene, test::busy_field(scene));
  MomentLog expected, log;
  for (int block = 0; block < 4; ++block) {
    cpu->advance(40, expected);
    device.advance(40, log);
    device.wait();
  }
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  EXPECT_GT(test::contacts_in(expected), 1000);
}

INSTANTIATE_TEST_SUITE_P(Both, DeviceResolutions, testing::Values(Resolution::independent, Resolution::coupled),
                         [](const auto& resolution) {
                           return resolution.param == Resolution::coupled ? std::string("coupled")
                                                                          : std::string("independent");
                         });

}  // namespace
}  // namespace gem
