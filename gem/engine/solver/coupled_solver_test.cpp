// The coupled solver: no contact closes after the events, and friction stays within Coulomb's cone.
#include "gem/engine/solver/coupled_solver.h"

#include <gtest/gtest.h>

#include "gem/engine/cpu/pair_list.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/testing/speed_still_asked.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

/// A crowded scene some seconds after its start, and one resolved time step of it.
struct Resolved {
  FieldState field;
  PairList pairs;
  CoupledSolver solver;
  StepQuality quality;
};

void resolve(Resolved& r, std::uint64_t seed) {
  SceneDef scene = test::busy_scene(seed);
  scene.numerics.iterations_maximum = 5000;
  const auto engine = test::busy_engine(scene, "cpu");
  StepLog log;
  engine->advance(300, log);
  r.field = make_field_state(engine->bodies(), step_constants(scene, engine->bodies()));
  r.field.platform_position = r.field.bodies.position[0];
  ThreadTeam team(1);
  team.run([&](int rank) {
    r.pairs.find(r.field, team, rank);
    team.single(rank, [&] { r.solver.lay_out(r.field, r.pairs.contacts(), team.size()); });
    r.solver.resolve(r.field, r.pairs.contacts(), team, rank, r.quality);
  });
}

TEST(CoupledSolver, LeavesNothingClosingAndKeepsTheCone) {
  Resolved r;
  resolve(r, 4);
  const double residual = r.field.constants.residual_speed;
  ASSERT_LE(r.quality.residual, residual) << "did not settle within " << r.quality.iterations << " iterations";
  int pressed = 0;
  for (const Contact* contact : r.pairs.contacts()) {
    for (int k = 0; k < contact->count; ++k) {
      const ContactSlot& slot = contact->slot[k];
      const double u_n = dot(relative_velocity(r.field.bodies, *contact, slot), contact->normal);
      // the velocities belong to the impulses before extrapolation, the residual to the extrapolated ones
      EXPECT_GE(u_n - slot.target, -test::speed_still_asked(r.field.bodies, residual));
      EXPECT_GE(slot.impulse.normal, 0.0);
      EXPECT_LE(std::fabs(slot.impulse.tangential), contact->friction * slot.impulse.normal * (1.0 + 1e-12));
      pressed += slot.impulse.normal > 0.0;
    }
  }
  EXPECT_GT(pressed, 20);
}

}  // namespace
}  // namespace gem
