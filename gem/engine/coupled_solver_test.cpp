// The coupled resolution: no moving body twice in a colour, no closing contact left, Coulomb's cone kept.
#include "gem/engine/coupled_solver.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "gem/engine/contact_stages.h"
#include "gem/engine/pair_list.h"
#include "gem/engine/test_scenes.h"

namespace gem {
namespace {

/// A crowd on its way, some seconds after the start, and one resolved moment of it.
struct Resolved {
  FieldState field;
  PairList pairs;
  CoupledSolver solver;
  MomentQuality quality;
};

void resolve(Resolved& r, std::uint64_t seed, int threads) {
  SceneDef scene = test::busy_scene(seed);
  scene.numerics.iterations_maximum = 5000;
  const auto engine = test::busy_engine(scene, "cpu", threads);
  MomentLog log;
  engine->advance(300, log);
  r.field = make_field_state(engine->bodies(), moment_constants(scene, engine->bodies()));
  r.field.platform_position = r.field.bodies.position[0];
  ThreadTeam team(threads);
  team.run([&](int rank) {
    r.pairs.find(r.field, team, rank);
    r.solver.resolve(r.field, r.pairs.contacts(), team, rank, r.quality);
  });
}

TEST(CoupledSolver, NoMovingBodyTwiceInAColour) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Resolved r;
    resolve(r, seed, 1);
    const Contacts contacts = r.pairs.contacts();
    const std::vector<std::uint8_t>& colours = r.solver.colours();
    ASSERT_GT(contacts.size(), 50u);
    ASSERT_EQ(colours.size(), contacts.size());
    std::set<std::pair<int, std::int32_t>> taken;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Contact& contact = *contacts[i];
      if (sweeps_write_a(r.field.bodies, contact)) {
        EXPECT_TRUE(taken.insert({colours[i], contact.a}).second);
      }
      if (r.field.bodies.inverse_mass[contact.b] > 0.0) {
        EXPECT_TRUE(taken.insert({colours[i], contact.b}).second);
      }
    }
  }
}

TEST(CoupledSolver, LeavesNothingClosingAndKeepsTheCone) {
  Resolved r;
  resolve(r, 4, 1);
  const double residual = r.field.constants.residual_speed;
  ASSERT_LE(r.quality.residual, residual) << "did not settle within " << r.quality.iterations << " sweeps";
  int pressed = 0;
  for (const Contact* contact : r.pairs.contacts()) {
    for (int k = 0; k < contact->count; ++k) {
      const ContactSlot& slot = contact->slot[k];
      const double u_n = dot(relative_velocity(r.field.bodies, *contact, slot), contact->normal);
      EXPECT_GE(u_n - slot.target, -30.0 * residual);  // a neighbour may have moved after the last visit
      EXPECT_GE(slot.impulse.normal, 0.0);
      EXPECT_LE(std::fabs(slot.impulse.tangential), contact->friction * slot.impulse.normal * (1.0 + 1e-12));
      pressed += slot.impulse.normal > 0.0;
    }
  }
  EXPECT_GT(pressed, 20);
}

}  // namespace
}  // namespace gem
