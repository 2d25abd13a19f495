// The device's recipe, run by one host thread, gives the bits, the books and the log of the cpu engine.
#include "gem/engine/device_moments.h"

#include <gtest/gtest.h>

#include <cstring>
#include <tuple>

#include "gem/engine/books.h"
#include "gem/engine/scene_image.h"
#include "gem/engine/test_scenes.h"

namespace gem {
namespace {

/// A device scene in the memory of the host.
class HostScene {
 public:
  HostScene(const SceneDef& scene, const Bodies& bodies, std::int32_t rows = 0)
      : field_(make_field_state(bodies, moment_constants(scene, bodies))),
        sizes_(scene_sizes(field_)),
        scene_(scene_constants(field_, scene.output.event_speed_m_per_s)) {
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
      SoloCrew crew;
      advance_scene(scene_, crew, some);
      const DeviceStatus& status = *scene_.status;
      append_log(field_, scene_, status, 1, log);
      moments -= status.samples;
      if (status.stop == DeviceStop::list_full) {
        sizes_.rows = std::max(sizes_.rows, status.rows_needed);
        sizes_.platform_rows = std::max(sizes_.platform_rows, status.platform_needed);
        grow();
        ++growths_;
      }
      if (status.stop == DeviceStop::not_finite) break;
    }
    read_state(scene_.state, field_);
  }

  Ledger ledger(const Ledger& start) {
    Ledger running;
    running.start = start.start;
    field_.books.assign(scene_.books, scene_.books + field_.books.size());
    field_.mooring_force = scene_.platform->mooring_force;
    return closed_books(field_, running);
  }

  const Bodies& bodies() const { return field_.bodies; }
  const DeviceStatus& status() const { return *scene_.status; }
  int growths() const { return growths_; }

 private:
  void grow() {
    memory_[1].resize(place_list(scene_, sizes_, nullptr));
    std::memset(memory_[1].data(), 0xff, memory_[1].size());
    place_list(scene_, sizes_, memory_[1].data());
  }

  FieldState field_;
  SceneSizes sizes_;
  DeviceScene scene_;
  std::vector<std::byte> memory_[3];
  int growths_ = 0;
};

bool same(Vec2 a, Vec2 b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void expect_same_bodies(const Bodies& a, const Bodies& b) {
  for (std::size_t i = 0; i < a.count(); ++i) {
    ASSERT_TRUE(same(a.position[i], b.position[i])) << "position of body " << i;
    ASSERT_TRUE(same(a.velocity[i], b.velocity[i])) << "velocity of body " << i;
    ASSERT_EQ(std::memcmp(&a.rotation[i], &b.rotation[i], sizeof(Rotation)), 0) << "rotation of body " << i;
    ASSERT_EQ(std::memcmp(&a.spin[i], &b.spin[i], sizeof(double)), 0) << "spin of body " << i;
    ASSERT_EQ(a.active[i], b.active[i]) << "body " << i;
  }
}

void expect_same_log(const MomentLog& a, const MomentLog& b) {
  ASSERT_EQ(a.platform.size(), b.platform.size());
  ASSERT_EQ(a.quality.size(), b.quality.size());
  for (std::size_t m = 0; m < a.platform.size(); ++m) {
    const PlatformMoment &p = a.platform[m], &q = b.platform[m];
    ASSERT_TRUE(same(p.position, q.position)) << "moment " << m;
    ASSERT_TRUE(same(p.velocity, q.velocity)) << "moment " << m;
    ASSERT_TRUE(same(p.ice_impulse, q.ice_impulse)) << "moment " << m;
    ASSERT_EQ(p.ice_yaw_impulse, q.ice_yaw_impulse) << "moment " << m;
    ASSERT_TRUE(same(p.mooring_impulse, q.mooring_impulse)) << "moment " << m;
    ASSERT_TRUE(same(p.drag_impulse, q.drag_impulse)) << "moment " << m;
    ASSERT_EQ(p.spin, q.spin) << "moment " << m;
    ASSERT_EQ(p.contacts, q.contacts) << "moment " << m;
    ASSERT_EQ(a.quality[m].contacts, b.quality[m].contacts) << "moment " << m;
    ASSERT_EQ(a.quality[m].maximum_overlap, b.quality[m].maximum_overlap) << "moment " << m;
  }
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t k = 0; k < a.events.size(); ++k) {
    const ContactEvent &e = a.events[k], &g = b.events[k];
    ASSERT_EQ(std::tie(e.time, e.body_a, e.body_b, e.closing_speed, e.impulse_normal, e.impulse_tangential),
              std::tie(g.time, g.body_a, g.body_b, g.closing_speed, g.impulse_normal, g.impulse_tangential));
    ASSERT_EQ(std::tie(e.effective_mass, e.peak_force, e.width, e.growth, e.depth),
              std::tie(g.effective_mass, g.peak_force, g.width, g.growth, g.depth));
    ASSERT_TRUE(same(e.point, g.point));
  }
}

void expect_same_books(const Ledger& a, const Ledger& b) {
  for (std::size_t c = 0; c < a.channel.size(); ++c) {
    EXPECT_TRUE(same(a.channel[c].momentum, b.channel[c].momentum)) << channel_name(Channel(c));
    EXPECT_EQ(a.channel[c].angular_momentum, b.channel[c].angular_momentum) << channel_name(Channel(c));
    EXPECT_EQ(a.channel[c].energy, b.channel[c].energy) << channel_name(Channel(c));
  }
  EXPECT_TRUE(same(a.mooring_force.momentum, b.mooring_force.momentum));
  EXPECT_EQ(a.mooring_force.angular_momentum, b.mooring_force.angular_momentum);
  EXPECT_EQ(a.now.energy, b.now.energy);
}

using Choice = std::tuple<Manifold, Yaw, FrictionLaw, DragLaw>;

class DeviceMomentsTest : public testing::TestWithParam<Choice> {};

TEST_P(DeviceMomentsTest, GivesTheBitsOfTheCpuEngine) {
  SceneDef scene = test::busy_scene(5);
  scene.contact.resolution = Resolution::independent;
  std::tie(scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law, scene.water.drag_law) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device(scene, test::busy_field(scene));
  MomentLog expected, log;
  for (int block = 0; block < 8; ++block) {
    cpu->advance(50, expected);
    device.advance(50, log);
    expect_same_bodies(device.bodies(), cpu->bodies());
    expect_same_log(log, expected);
    if (HasFatalFailure()) return;
  }
  expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  EXPECT_GT(test::contacts_in(expected), 5000);
  EXPECT_GT(expected.events.size(), 5u);
  EXPECT_GT(device.status().builds, 3);
}

INSTANTIATE_TEST_SUITE_P(Combinations, DeviceMomentsTest,
                         testing::Combine(testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic, DragLaw::linear, DragLaw::none)));

TEST(DeviceMoments, AListTooSmallGrowsAndLosesNothing) {
  SceneDef scene = test::busy_scene(6);
  scene.contact.resolution = Resolution::independent;
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device(scene, test::busy_field(scene), 64);
  MomentLog expected, log;
  cpu->advance(200, expected);
  device.advance(200, log);
  EXPECT_GT(device.growths(), 0);
  expect_same_bodies(device.bodies(), cpu->bodies());
  expect_same_log(log, expected);
  EXPECT_GT(test::contacts_in(expected), 2000);
}

}  // namespace
}  // namespace gem
