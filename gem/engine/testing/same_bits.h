// For tests: two runs have the same bits in state, log and books; or how far they differ.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <tuple>

#include "gem/engine/engine.h"

namespace gem::test {

inline bool same(Vec2 a, Vec2 b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Largest distance between the positions of a body in two states [m].
inline double farthest_apart(const Bodies& a, const Bodies& b) {
  double apart = 0.0;
  for (std::size_t i = 0; i < a.count(); ++i) apart = std::max(apart, length(a.position[i] - b.position[i]));
  return apart;
}

inline void expect_same_bodies(const Bodies& a, const Bodies& b) {
  for (std::size_t i = 0; i < a.count(); ++i) {
    ASSERT_TRUE(same(a.position[i], b.position[i])) << "position of body " << i;
    ASSERT_TRUE(same(a.velocity[i], b.velocity[i])) << "velocity of body " << i;
    ASSERT_EQ(std::memcmp(&a.rotation[i], &b.rotation[i], sizeof(Rotation)), 0) << "rotation of body " << i;
    ASSERT_EQ(std::memcmp(&a.spin[i], &b.spin[i], sizeof(double)), 0) << "spin of body " << i;
    ASSERT_EQ(a.active[i], b.active[i]) << "body " << i;
  }
}

inline void expect_same_dp(const std::vector<DpState>& a, const std::vector<DpState>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t m = 0; m < a.size(); ++m) {
    const DpState &p = a[m], &q = b[m];
    ASSERT_EQ(p.steps, q.steps) << "time step " << m;
    ASSERT_TRUE(same(p.offset, q.offset) && same(p.velocity, q.velocity) && same(p.integral, q.integral))
        << "time step " << m;
    ASSERT_EQ(std::tie(p.yaw, p.spin, p.yaw_integral, p.yaw_offset, p.at_limit),
              std::tie(q.yaw, q.spin, q.yaw_integral, q.yaw_offset, q.at_limit))
        << "time step " << m;
    for (const auto& [f, g] : {std::pair{p.demand, q.demand}, std::pair{p.given, q.given}})
      ASSERT_EQ(std::tie(f.surge, f.sway, f.yaw), std::tie(g.surge, g.sway, g.yaw)) << "time step " << m;
    for (std::int32_t i = 0; i < thrusters_maximum; ++i)
      ASSERT_TRUE(same(p.thrust[i], q.thrust[i])) << "time step " << m << ", thruster " << i;
  }
}

inline void expect_same_log(const StepLog& a, const StepLog& b) {
  ASSERT_EQ(a.platform.size(), b.platform.size());
  ASSERT_EQ(a.quality.size(), b.quality.size());
  for (std::size_t m = 0; m < a.platform.size(); ++m) {
    const PlatformStep &p = a.platform[m], &q = b.platform[m];
    ASSERT_TRUE(same(p.position, q.position)) << "time step " << m;
    ASSERT_TRUE(same(p.velocity, q.velocity)) << "time step " << m;
    ASSERT_TRUE(same(p.ice_impulse, q.ice_impulse)) << "time step " << m;
    ASSERT_EQ(p.ice_yaw_impulse, q.ice_yaw_impulse) << "time step " << m;
    ASSERT_TRUE(same(p.mooring_impulse, q.mooring_impulse)) << "time step " << m;
    ASSERT_TRUE(same(p.drag_impulse, q.drag_impulse)) << "time step " << m;
    ASSERT_EQ(p.spin, q.spin) << "time step " << m;
    ASSERT_EQ(p.contacts, q.contacts) << "time step " << m;
    ASSERT_EQ(p.broken, q.broken) << "time step " << m;
    ASSERT_EQ(a.quality[m].contacts, b.quality[m].contacts) << "time step " << m;
    ASSERT_EQ(a.quality[m].iterations, b.quality[m].iterations) << "time step " << m;
    ASSERT_EQ(a.quality[m].residual, b.quality[m].residual) << "time step " << m;
    ASSERT_EQ(a.quality[m].maximum_overlap, b.quality[m].maximum_overlap) << "time step " << m;
    ASSERT_EQ(a.quality[m].maximum_share, b.quality[m].maximum_share) << "time step " << m;
  }
  expect_same_dp(a.dp, b.dp);
  ASSERT_EQ(a.overlap.count, b.overlap.count);
  ASSERT_EQ(a.overlap_share.count, b.overlap_share.count);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t k = 0; k < a.events.size(); ++k) {
    const ContactEvent &e = a.events[k], &g = b.events[k];
    ASSERT_EQ(std::tie(e.time, e.body_a, e.body_b, e.closing_speed, e.impulse_normal, e.impulse_tangential),
              std::tie(g.time, g.body_a, g.body_b, g.closing_speed, g.impulse_normal, g.impulse_tangential));
    ASSERT_EQ(std::tie(e.effective_mass, e.peak_force, e.largest_force, e.width, e.growth, e.depth),
              std::tie(g.effective_mass, g.peak_force, g.largest_force, g.width, g.growth, g.depth));
    ASSERT_TRUE(same(e.point, g.point));
  }
}

inline void expect_same_splits(const StepLog& a, const StepLog& b) {
  ASSERT_EQ(a.splits.size(), b.splits.size());
  for (std::size_t k = 0; k < a.splits.size(); ++k) {
    const SplitEvent &e = a.splits[k], &g = b.splits[k];
    ASSERT_EQ(std::tie(e.time, e.split.floe, e.split.result, e.split.piece[0], e.split.piece[1], e.split.length),
              std::tie(g.time, g.split.floe, g.split.result, g.split.piece[0], g.split.piece[1], g.split.length));
    ASSERT_EQ(std::tie(e.force, e.splitting_force, e.energy), std::tie(g.force, g.splitting_force, g.energy));
    ASSERT_TRUE(same(e.point, g.point) && same(e.along, g.along)) << "split " << k;
  }
}

inline void expect_same_forces(const std::vector<ContactForce>& a, const std::vector<ContactForce>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(std::tie(a[k].a, a[k].b), std::tie(b[k].a, b[k].b));
    ASSERT_TRUE(same(a[k].point, b[k].point) && same(a[k].force, b[k].force)) << a[k].a << " on " << a[k].b;
  }
}

inline void expect_same_loads(const LoadSums& a, const LoadSums& b) {
  ASSERT_EQ(std::tie(a.crack_energy, a.full), std::tie(b.crack_energy, b.full));
  for (const auto& [some, others] : {std::pair{a.before, b.before}, std::pair{a.now, b.now}}) {
    ASSERT_EQ(some.size(), others.size());
    for (std::size_t k = 0; k < some.size(); ++k) {
      const ContactLoad &p = some[k], &q = others[k];
      ASSERT_EQ(std::tie(p.a, p.b, p.weight), std::tie(q.a, q.b, q.weight));
      ASSERT_TRUE(same(p.impulse, q.impulse) && same(p.arm_a, q.arm_a) && same(p.arm_b, q.arm_b));
    }
  }
}

/// Splits of a log that were made.
inline std::int64_t splits_in(const StepLog& log) {
  return std::count_if(log.splits.begin(), log.splits.end(),
                       [](const SplitEvent& s) { return s.split.result == FloeSplit::Result::split; });
}

/// The quality of coupled time steps after the events.
inline void expect_same_judgement(const StepLog& a, const StepLog& b) {
  ASSERT_EQ(a.quality.size(), b.quality.size());
  for (std::size_t m = 0; m < a.quality.size(); ++m) {
    ASSERT_EQ(a.quality[m].complementarity, b.quality[m].complementarity) << "time step " << m;
    ASSERT_EQ(a.quality[m].cone_excess, b.quality[m].cone_excess) << "time step " << m;
    ASSERT_EQ(a.quality[m].energy_created, b.quality[m].energy_created) << "time step " << m;
  }
}

/// The warm start of the contact points, and what corners remember.
inline void expect_same_memory(const EngineState& a, const EngineState& b) {
  ASSERT_EQ(a.corner_key, b.corner_key);
  ASSERT_EQ(a.substeps, b.substeps);
  const std::size_t bytes = b.corner_value.size() * sizeof(CornerMemory);
  ASSERT_EQ(a.corner_value.size(), b.corner_value.size());
  if (bytes > 0) {
    EXPECT_EQ(std::memcmp(a.corner_value.data(), b.corner_value.data(), bytes), 0);
  }
  ASSERT_EQ(a.impulse_key, b.impulse_key);
  ASSERT_EQ(a.impulse_value.size(), b.impulse_value.size());
  if (b.impulse_value.empty()) return;
  EXPECT_EQ(
      std::memcmp(a.impulse_value.data(), b.impulse_value.data(), b.impulse_value.size() * sizeof b.impulse_value[0]),
      0);
}

inline void expect_same_books(const Ledger& a, const Ledger& b) {
  for (std::size_t c = 0; c < a.channel.size(); ++c) {
    EXPECT_TRUE(same(a.channel[c].momentum, b.channel[c].momentum)) << channel_name(Channel(c));
    EXPECT_EQ(a.channel[c].angular_momentum, b.channel[c].angular_momentum) << channel_name(Channel(c));
    EXPECT_EQ(a.channel[c].energy, b.channel[c].energy) << channel_name(Channel(c));
  }
  EXPECT_TRUE(same(a.mooring_force.momentum, b.mooring_force.momentum));
  EXPECT_EQ(a.mooring_force.angular_momentum, b.mooring_force.angular_momentum);
  EXPECT_EQ(a.now.energy, b.now.energy);
  EXPECT_EQ(a.crack_energy, b.crack_energy);
  for (const auto member :
       {&ContactEnergy::work, &ContactEnergy::stored, &ContactEnergy::crushed, &ContactEnergy::damped,
        &ContactEnergy::friction, &ContactEnergy::load, &ContactEnergy::softened})
    EXPECT_EQ(a.contact.*member, b.contact.*member);
}

}  // namespace gem::test
