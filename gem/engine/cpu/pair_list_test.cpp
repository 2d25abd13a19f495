// The pair list against a test of all pairs, on fields that move, turn and lose bodies. The list must last for many
// time steps.
#include "gem/engine/cpu/pair_list.h"

#include <gtest/gtest.h>

#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/solo_stages.h"
#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

std::vector<Contact> all_pairs(const FieldState& f) {
  const Bodies& b = f.bodies;
  std::vector<Contact> contacts;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(b.count()); ++i)
    for (std::int32_t j = i + 1; j < static_cast<std::int32_t>(b.count()); ++j) {
      if (!b.active[i] || !b.active[j] || (b.inverse_mass[i] == 0.0 && b.inverse_mass[j] == 0.0)) continue;
      SeparatingAxes unknown;
      Contact contact;
      if (find_contact(f, i, j, unknown, 0.0, contact)) contacts.push_back(contact);
    }
  return contacts;
}

void expect_same(const Contact& a, const Contact& b) {
  ASSERT_EQ(a.a, b.a);
  ASSERT_EQ(a.b, b.b);
  ASSERT_EQ(a.count, b.count);
  ASSERT_EQ(a.normal.x, b.normal.x);
  ASSERT_EQ(a.normal.y, b.normal.y);
  ASSERT_EQ(a.width, b.width);
  for (int k = 0; k < a.count; ++k) {
    ASSERT_EQ(a.slot[k].separation, b.slot[k].separation);
    ASSERT_EQ(a.slot[k].feature, b.slot[k].feature);
    ASSERT_EQ(a.slot[k].arm_a.x, b.slot[k].arm_a.x);
    ASSERT_EQ(a.slot[k].arm_b.y, b.slot[k].arm_b.y);
  }
}

/// Moves every floe with a velocity that varies randomly. Now and then one floe jumps and one is removed.
void wander(FieldState& f, RandomSequence& random) {
  Bodies& b = f.bodies;
  for (std::size_t i = 0; i < b.count(); ++i) {
    if (b.kind[i] == BodyKind::fixed) continue;
    b.velocity[i] += Vec2{random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02)};
    if (random.uniform() < 1e-4) b.velocity[i] = {random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)};
    if (b.kind[i] == BodyKind::floe && random.uniform() < 1e-4) b.active[i] = 0;
    b.position[i] += f.constants.dt * b.velocity[i];
    turn_body(f, i, f.constants.dt * b.spin[i]);
  }
}

class PairListTest : public testing::TestWithParam<Manifold> {};

TEST_P(PairListTest, FindsWhatAllPairsFind) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SceneDef scene = test::busy_scene(seed);
    scene.contact.manifold = GetParam();
    Bodies bodies = test::busy_field(scene);
    for (Vec2& v : bodies.velocity) v = 0.3 * v;
    FieldState f = make_field_state(bodies, step_constants(scene, bodies));
    RandomSequence random(Random(seed, 5));
    ThreadTeam team(1 + static_cast<int>(seed));
    PairList pairs;
    constexpr int steps = 200;
    std::size_t found = 0;
    for (int m = 0; m < steps; ++m) {
      team.run([&](int rank) { pairs.find(f, team, rank); });
      const std::vector<Contact> expected = all_pairs(f);
      const Contacts contacts = pairs.contacts();
      ASSERT_EQ(contacts.size(), expected.size()) << "seed " << seed << " time step " << m;
      for (std::size_t i = 0; i < expected.size(); ++i) expect_same(*contacts[i], expected[i]);
      if (HasFatalFailure()) FAIL() << "seed " << seed << " time step " << m;
      found += expected.size();
      wander(f, random);
    }
    EXPECT_GT(found, 2500u);
    EXPECT_LT(pairs.builds(), steps / 5) << "a list that is built all the time spares nothing";
    EXPECT_GT(pairs.builds(), 2) << "no list was ever out of date: the field hardly moved";
  }
}

INSTANTIATE_TEST_SUITE_P(Manifolds, PairListTest, testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                         test::LawNames());

TEST(PairList, ForgetsOnRequest) {
  const SceneDef scene = test::busy_scene(4);
  const Bodies bodies = test::busy_field(scene);
  const FieldState f = make_field_state(bodies, step_constants(scene, bodies));
  ThreadTeam team(1);
  PairList pairs;
  auto find = [&] { team.run([&](int rank) { pairs.find(f, team, rank); }); };
  find();
  find();
  EXPECT_EQ(pairs.builds(), 1);
  EXPECT_GT(pairs.size(), 100u);
  pairs.clear();
  find();
  EXPECT_EQ(pairs.builds(), 2);
}

}  // namespace
}  // namespace gem
