#include "validation/agreement/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "gem/engine/testing/speed_still_asked.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/field/field.h"
#include "gem/scene/scene_bounds.h"
#include "gem/scene/scene_drive.h"
#include "validation/agreement/jam.h"

namespace gem::agreement {
namespace {

/// Chosen, see comparison.h: roundings of the largest speed in a time step for each contact, roundings of the farthest
/// place, and how much an error of a share grows in the effective mass and the peak of an event.
constexpr double speed_roundings = 100.0, place_roundings = 10.0, growth_of_share = 10.0;

double largest_speed(const Bodies& b) {
  double speed = 0.0;
  for (std::size_t i = 0; i < b.count(); ++i)
    if (b.active[i]) speed = std::max(speed, length(b.velocity[i]) + b.radius[i] * std::fabs(b.spin[i]));
  return speed;
}

double total_mass(const Bodies& b) {
  double mass = 0.0;
  for (const double m : b.mass) mass += m;
  return mass;
}

/// Most contact points, and most contacts, of a moving body.
struct Crowd {
  int points = 0, contacts = 0;
  void widen(const Crowd& other) {
    points = std::max(points, other.points);
    contacts = std::max(contacts, other.contacts);
  }
};

/// Counted in the last time step of a coupled scene, whose keys the engine keeps.
Crowd crowd_of(const EngineState& state) {
  std::vector<Crowd> of_body(state.bodies.count());
  for (std::size_t k = 0; k < state.impulse_key.size(); ++k) {
    const std::uint64_t key = state.impulse_key[k], last = k > 0 ? state.impulse_key[k - 1] : 0;
    const bool second = k > 0 && body_a_of(last) == body_a_of(key) && body_b_of(last) == body_b_of(key);
    for (const std::int32_t body : {body_a_of(key), body_b_of(key)}) {
      ++of_body[body].points;
      if (!second) ++of_body[body].contacts;
    }
  }
  Crowd most;
  for (std::size_t i = 0; i < of_body.size(); ++i)
    if (state.bodies.inverse_mass[i] > 0.0) most.widen(of_body[i]);
  return most;
}

/// What two engines may differ by.
struct Allowed {
  double velocity, position;  // of any point of a body [m/s], [m]
  double mass, speed, reach;  // of all bodies [kg]; largest [m/s]; farthest place from the origin [m]
  double lightest, smallest;  // moving body [kg]; root of an area [m]
  double rim;                 // bound on m K for a point of a body of mass m: 1 + m R^2 / I [-]
  double asked;               // what a point of the cpu engine may still ask for [m/s]
  double impulse() const { return mass * velocity; }
  double twist() const { return reach * impulse(); }
  double energy() const { return impulse() * speed; }
};

void expect_near(Vec2 a, Vec2 b, double allowed, const std::string& what) { EXPECT_LE(length(a - b), allowed) << what; }

void expect_bodies(const Bodies& a, const Bodies& b, const Allowed& allowed) {
  for (std::size_t i = 0; i < a.count(); ++i) {
    const std::string body = "body " + std::to_string(i);
    const double radius = a.radius[i];
    ASSERT_EQ(a.active[i], b.active[i]) << body;
    expect_near(a.velocity[i], b.velocity[i], allowed.velocity, "velocity of " + body);
    expect_near(a.position[i], b.position[i], allowed.position, "position of " + body);
    EXPECT_LE(radius * std::fabs(a.spin[i] - b.spin[i]), allowed.velocity) << "spin of " << body;
    EXPECT_LE(radius * std::fabs(a.rotation[i].sine - b.rotation[i].sine), allowed.position) << "turn of " << body;
    EXPECT_LE(radius * std::fabs(a.rotation[i].cosine - b.rotation[i].cosine), allowed.position) << "turn of " << body;
  }
}

void expect_sample(const PlatformStep& a, const PlatformStep& b, const Allowed& allowed, double radius) {
  EXPECT_EQ(a.broken, b.broken) << "broken lines";
  EXPECT_LE(radius * std::fabs(a.spin - b.spin), allowed.velocity) << "sampled spin";
  EXPECT_LE(radius * std::fabs(a.rotation.sine - b.rotation.sine), allowed.position) << "sampled turn";
  EXPECT_LE(radius * std::fabs(a.rotation.cosine - b.rotation.cosine), allowed.position) << "sampled turn";
  expect_near(a.position, b.position, allowed.position, "sampled position");
  expect_near(a.velocity, b.velocity, allowed.velocity, "sampled velocity");
  expect_near(a.ice_impulse, b.ice_impulse, allowed.impulse(), "ice impulse");
  expect_near(a.mooring_impulse, b.mooring_impulse, allowed.impulse(), "mooring impulse");
  expect_near(a.drag_impulse, b.drag_impulse, allowed.impulse(), "drag impulse");
  EXPECT_LE(std::fabs(a.ice_yaw_impulse - b.ice_yaw_impulse), allowed.twist());
}

Quantity operator+(const Quantity& a, const Quantity& b) {
  return {a.momentum + b.momentum, a.angular_momentum + b.angular_momentum, a.energy + b.energy};
}

void expect_quantity(const Quantity& a, const Quantity& b, const Allowed& allowed, const std::string& name) {
  expect_near(a.momentum, b.momentum, allowed.impulse(), name);
  EXPECT_LE(std::fabs(a.angular_momentum - b.angular_momentum), allowed.twist()) << name;
  EXPECT_LE(std::fabs(a.energy - b.energy), allowed.energy()) << name;
}

/// Two points of a face that both stick share their impulse in many ways with the same motion: with friction only the
/// sum of impact and friction has one answer.
void expect_books(const Ledger& a, const Ledger& b, const Allowed& allowed, bool rough) {
  for (const Channel c :
       {Channel::elastic, Channel::repair, Channel::drag, Channel::mooring, Channel::platform_drag, Channel::retired})
    expect_quantity(a[c], b[c], allowed, channel_name(c));
  expect_quantity(a[Channel::impact] + a[Channel::friction], b[Channel::impact] + b[Channel::friction], allowed,
                  "impact and friction");
  if (!rough) expect_quantity(a[Channel::impact], b[Channel::impact], allowed, "impact");
  expect_quantity(a.mooring_force, b.mooring_force, allowed, "mooring spring");
  expect_quantity(a.now, b.now, allowed, "total");
}

/// Events, without those whose impulse is only rounding.
std::vector<ContactEvent> events_of(const StepLog& log, const Allowed& allowed) {
  std::vector<ContactEvent> events = log.events;
  std::erase_if(events, [&](const ContactEvent& e) { return e.impulse_normal <= allowed.impulse(); });
  return events;
}

void expect_events(const StepLog& a, const StepLog& b, const Allowed& allowed) {
  const std::vector<ContactEvent> of_a = events_of(a, allowed), of_b = events_of(b, allowed);
  ASSERT_EQ(of_a.size(), of_b.size());
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    const ContactEvent &e = of_a[k], &g = of_b[k];
    EXPECT_EQ(e.time, g.time);
    EXPECT_EQ(e.body_a, g.body_a);
    EXPECT_EQ(e.body_b, g.body_b);
    EXPECT_LE(std::fabs(e.impulse_normal - g.impulse_normal), allowed.impulse());
    EXPECT_LE(std::fabs(e.impulse_tangential - g.impulse_tangential), allowed.impulse());
    // a share of the impulse is all that weighs the points of one event
    const double share = 1e-12 + allowed.impulse() / e.impulse_normal + allowed.velocity / e.closing_speed;
    EXPECT_NEAR(e.closing_speed, g.closing_speed, share * allowed.speed + allowed.velocity);
    EXPECT_NEAR(e.effective_mass, g.effective_mass, growth_of_share * share * e.effective_mass);
    EXPECT_NEAR(e.peak_force, g.peak_force, growth_of_share * share * e.peak_force);
    expect_near(e.point, g.point, share * allowed.reach + allowed.position, "point of an event");
    expect_near(e.normal, g.normal, allowed.position, "normal of an event");
    EXPECT_NEAR(e.width, g.width, allowed.position);
    // cot a + cot b of the angles between both edges and the normal; each turns by no more than position over size
    EXPECT_NEAR(e.growth, g.growth, 2.0 * allowed.position / allowed.smallest * (1.0 + e.growth * e.growth));
    EXPECT_NEAR(e.depth, g.depth, allowed.position);
  }
}

Allowed allowed_in(const Comparison& c, const Bodies& bodies, int steps, int points_of_a_body) {
  Allowed allowed{};
  allowed.speed = std::max({1e-3, largest_speed(bodies), drive_speed(c.scene), platform_speed_bound(c.scene)});
  allowed.mass = total_mass(bodies);
  allowed.lightest = allowed.smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.area[i] > 0.0) allowed.smallest = std::min(allowed.smallest, std::sqrt(bodies.area[i]));
    if (bodies.mass[i] > 0.0) {
      allowed.lightest = std::min(allowed.lightest, bodies.mass[i]);
      allowed.rim =
          std::max(allowed.rim, 1.0 + bodies.radius[i] * bodies.radius[i] * bodies.mass[i] * bodies.inverse_inertia[i]);
    }
    if (bodies.kind[i] != BodyKind::fixed)
      allowed.reach = std::max(allowed.reach, length(bodies.position[i]) + bodies.radius[i]);
  }
  const double rounding = 1.1e-16 * steps;
  allowed.velocity = speed_roundings * c.contacts_of_a_body * rounding * allowed.speed + c.slack;
  if (c.scene.contact.solver == ContactSolver::coupled) {
    const double n = 2.0 * c.row / 3.14, residual = c.scene.numerics.residual_tolerance * allowed.speed;
    allowed.velocity += steps * points_of_a_body * n * n * residual;
    allowed.asked = test::speed_still_asked(bodies, residual);
  }
  allowed.position = place_roundings * rounding * allowed.reach + steps * dt * allowed.velocity;
  return allowed;
}

/// Overlaps beyond rounding, by depth [m] or share [-].
std::int64_t overlaps(const OverlapCount& counted) {
  constexpr double beyond_rounding = 1e-12;
  return std::accumulate(counted.count.begin() + 1 + OverlapCount::class_of(beyond_rounding), counted.count.end(),
                         std::int64_t{0});
}

void expect_quality(const StepQuality& a, const StepQuality& b, const Allowed& allowed) {
  EXPECT_NEAR(a.maximum_overlap, b.maximum_overlap, allowed.position);
  EXPECT_NEAR(a.maximum_share, b.maximum_share, allowed.position / allowed.smallest);
  // it follows u_n of two bodies, and K_n P_n with K_n of two bodies
  const double compliance = 2.0 * allowed.rim / allowed.lightest;
  EXPECT_NEAR(a.complementarity, b.complementarity,
              allowed.asked + 2.0 * allowed.velocity + compliance * allowed.impulse());
  EXPECT_NEAR(a.cone_excess, b.cone_excess, 2.0 * allowed.impulse());  // P_t, and mu P_n with mu below 1
  EXPECT_NEAR(a.energy_created, b.energy_created, allowed.energy());
}

}  // namespace

SceneDef still_scene() {
  SceneDef scene;
  scene.contact.solver = ContactSolver::coupled;
  scene.current.velocity_m_per_s = {0.0, 0.0};
  scene.water.drag_law = DragLaw::none;
  scene.ice.friction_ice = scene.ice.friction_structure = 0.0;
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = false;
  scene.platform.present = false;
  scene.contact.elastic_stiffness_N_per_m = 0.0;
  scene.contact.crushing_limit = false;
  scene.numerics.time_step_s = dt;
  scene.numerics.residual_tolerance = 1e-12;
  scene.numerics.iterations_maximum = 200000;
  scene.output.retire_x_m = 1e9;
  return scene;
}

FloeDef floe(double length, double width, Vec2 position, Vec2 velocity, double angle, double spin) {
  const double x = 0.5 * length, y = 0.5 * width;
  return {{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, position, angle, velocity, spin, 0.5};
}

void compare(const Comparison& c) {
  Bodies field = c.thrown ? test::busy_field(c.scene) : make_field(c.scene);
  field.position.back() += c.push;
  const auto cpu = make_engine(c.scene, field, on("cpu"));
  const auto reference = make_engine(c.scene, field, on("reference"));
  const bool coupled = c.scene.contact.solver == ContactSolver::coupled;
  if (c.start != nullptr) {
    cpu->restore(*c.start);
    reference->restore(*c.start);
  }
  std::int64_t contacts = 0;
  Crowd crowd;  // so far, or in a time step that starts anew
  if (c.begins) {
    StepLog log;
    bool begun = false;
    for (int step = 0; step < 1000 && !begun; ++step) {
      cpu->advance(1, log);
      begun = c.begins(log);
    }
    ASSERT_TRUE(begun) << "what is to be compared did not begin";
  }
  for (int step = 0; step < c.steps; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    if (c.anew) reference->restore(cpu->save());
    StepLog expected, log;
    cpu->advance(1, log);
    reference->advance(1, expected);
    if (c.anew) crowd = {};
    if (coupled) crowd.widen(crowd_of(cpu->save()));
    ASSERT_LE(crowd.contacts, c.contacts_of_a_body);
    const Allowed allowed = allowed_in(c, field, c.anew ? 1 : step + 1, crowd.points);
    ASSERT_LE(log.quality[0].residual, c.scene.numerics.residual_tolerance * allowed.speed) << "not converged";
    expect_bodies(cpu->bodies(), reference->bodies(), allowed);
    expect_sample(log.platform[0], expected.platform[0], allowed, field.radius[0]);
    expect_books(cpu->ledger(), reference->ledger(), allowed, c.scene.ice.friction_ice > 0.0);
    expect_events(log, expected, allowed);
    expect_quality(log.quality[0], expected.quality[0], allowed);
    EXPECT_EQ(overlaps(log.overlap), overlaps(expected.overlap));
    EXPECT_EQ(overlaps(log.overlap_share), overlaps(expected.overlap_share));
    if (!coupled) {  // coupled: whether an impulse that is rounding counts as none
      EXPECT_EQ(log.quality[0].contacts, expected.quality[0].contacts);
      EXPECT_EQ(log.platform[0].contacts, expected.platform[0].contacts);
    }
    contacts += expected.quality[0].contacts;
    if (c.also) c.also(expected);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GE(contacts, c.contacts);
}

}  // namespace gem::agreement
