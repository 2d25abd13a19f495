// The compliant contacts of the reference engine: against the closed form of a crushing hit, and as judge of the cpu
// engine. Both engines share the law and no other code; the reference has eight substeps for each one of the cpu
// engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "gem/base/error.h"
#include "gem/engine/reference/reference_engine.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/field/field.h"

namespace gem {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Nothing but compliant contacts and what a test adds.
SceneDef still_scene() {
  SceneDef scene;
  scene.current.velocity_m_per_s = {0.0, 0.0};
  scene.water.drag_law = DragLaw::none;
  scene.ice.friction_ice = scene.ice.friction_structure = 0.0;
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = false;
  scene.platform.present = false;
  scene.contact.solver = ContactSolver::compliant;
  scene.contact.face_stiffness_Pa = 5e8;  // hits are short
  scene.numerics.time_step_s = 0.005;
  scene.output.retire_x_m = 1e9;
  return scene;
}

/// As above, with a structure that is a wall at x = 0.
SceneDef wall_scene() {
  SceneDef scene = still_scene();
  scene.platform.present = scene.platform.fixed = true;
  scene.platform.outline = PlatformOutline::listed;
  scene.platform.anchor_m = {50.0, 0.0};
  scene.platform.outline_m = {{-50.0, -80.0}, {50.0, -80.0}, {50.0, 80.0}, {-50.0, 80.0}};
  return scene;
}

/// A rectangle of ice, 1 m thick, turned by `angle` [degrees].
FloeDef floe(double length, double width, Vec2 position, Vec2 velocity, double angle = 0.0, double spin = 0.0) {
  const double x = 0.5 * length, y = 0.5 * width;
  return {{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, position, angle * degree, velocity, spin, 1.0};
}

/// What a scene shows in a run.
struct Hits {
  double force = 0.0;       // largest normal force on the platform [N]
  double depth = 0.0;       // at the platform [m]
  double sprung = 0.0;      // largest elastic depth of all corners [m]
  double mean_force = 0.0;  // largest mean of a time step, of any pair [N]
  double duration = 0.0;    // of mean forces above a tenth of that [s]
  double impulse = 0.0;     // normal, on the platform [N s]
  std::int64_t substeps = 0;
  Bodies bodies;
  Ledger ledger;
};

/// Time for which a series with the spacing `dt` [s] is above `limit`, straight between its values.
double time_above(const std::vector<double>& series, double limit, double dt) {
  double time = 0.0;
  for (std::size_t i = 1; i < series.size(); ++i) {
    const double low = std::min(series[i - 1], series[i]), high = std::max(series[i - 1], series[i]);
    if (high > limit) time += dt * (low >= limit ? 1.0 : (high - limit) / (high - low));
  }
  return time;
}

Hits run(const SceneDef& scene, Engine& engine) {
  Hits hits;
  std::vector<double> force{0.0};
  const double dt = scene.numerics.time_step_s;
  StepLog log;
  for (std::int64_t i = 0; i < std::llround(scene.run.duration_s / dt); ++i) {
    log.clear();
    engine.advance(1, log);
    force.push_back(0.0);
    for (const ContactForce& f : engine.contact_forces()) force.back() = std::max(force.back(), length(f.force));
    for (const ContactEvent& e : log.events) {
      hits.force = std::max(hits.force, e.largest_force);
      hits.depth = std::max(hits.depth, e.depth);
      hits.impulse += e.impulse_normal;
    }
    hits.sprung = std::max(hits.sprung, log.quality.back().maximum_overlap);
  }
  hits.mean_force = *std::max_element(force.begin(), force.end());
  hits.duration = time_above(force, 0.1 * hits.mean_force, dt);
  hits.substeps = engine.save().substeps;
  hits.bodies = engine.bodies();
  hits.ledger = engine.ledger();
  return hits;
}

Hits run(const SceneDef& scene, const std::string& name) {
  return run(scene, *make_engine(scene, make_field(scene), {.name = name, .threads = 1}));
}

void expect_closed_books(const Hits& hits) {
  const LedgerResidual r = residual(hits.ledger);
  EXPECT_LT(r.momentum, 1e-12);
  EXPECT_LT(r.angular_momentum, 1e-12);
  EXPECT_LT(r.energy, 1e-12);
  const ContactEnergy& e = hits.ledger.contact;
  EXPECT_LT(std::fabs(e.left()), 0.01 * (e.crushed + e.damped + e.friction))
      << "its own integration, in J: " << e.left();
}

/// P0 (h g)^(1+ex) z^(1+ex) crushes: (2+ex) E / F deep.
TEST(ReferenceCompliant, ACornerCrushesAsInClosedForm) {
  SceneDef scene = wall_scene();
  scene.run.duration_s = 1.0;
  scene.floe = {floe(10.0, 10.0, {-7.1711, 0.0}, {0.5, 0.0}, 45.0)};
  const Hits hits = run(scene, "reference");
  EXPECT_NEAR(hits.force, 363.9e3, 0.005 * 363.9e3);
  EXPECT_NEAR(hits.depth, 0.0587, 0.005 * 0.0587);
  EXPECT_NEAR(hits.impulse, 90e3 * (0.5 - hits.bodies.velocity.back().x), 1e-6 * 45e3);
  EXPECT_LE(hits.bodies.velocity.back().x, 0.0);
  expect_closed_books(hits);
}

/// A scene in which both engines must find the same hit.
struct Case {
  std::string name;
  std::function<SceneDef()> scene;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

SceneDef wall_hit(const FloeDef& hitting, double friction = 0.0, double duration = 2.0) {
  SceneDef scene = wall_scene();
  scene.run.duration_s = duration;
  scene.ice.friction_structure = friction;
  scene.floe = {hitting};
  return scene;
}

/// A tilted face, 10 m, 0.1 m before the wall; until its other end comes near.
SceneDef tilted_face(double angle, double duration) {
  const double reach = 5.0 * (std::cos(angle * degree) + std::sin(angle * degree));
  return wall_hit(floe(10.0, 10.0, {-0.1 - reach, 0.0}, {0.5, 0.0}, angle), 0.0, duration);
}

SceneDef two_floes(double friction) {
  SceneDef scene = still_scene();
  scene.run.duration_s = 2.0;
  scene.ice.friction_ice = friction;
  scene.floe = {floe(12.0, 9.0, {0.0, 0.0}, {0.4, 0.0}, 17.0, 0.02),
                floe(10.0, 8.0, {12.8, 2.0}, {-0.3, 0.1}, 51.0, -0.03)};
  return scene;
}

SceneDef moored_platform() {
  SceneDef scene = still_scene();
  scene.run.duration_s = 3.0;
  scene.ice.friction_structure = 0.1;
  scene.platform.present = true;
  scene.platform.diameter_m = 20.0;
  scene.platform.mass_kg = 2e6;
  scene.platform.start_velocity_m_per_s = {0.0, 0.05};
  scene.mooring.stiffness_N_per_m = 2e5;
  scene.mooring.damping_ratio = 0.05;
  scene.floe = {floe(12.0, 9.0, {-17.6, 1.0}, {0.5, 0.0}, 12.0)};
  return scene;
}

std::vector<Case> cases() {
  return {
      {"corner_spins",
       [] {
         return wall_hit(floe(10.0, 10.0, {-7.1711, 0.0}, {0.5, 0.0}, 45.0, 0.2));
       }},
      {"corner_spins_in_long_steps",
       [] {
         SceneDef scene = wall_hit(floe(10.0, 10.0, {-7.1711, 0.0}, {0.5, 0.0}, 45.0, 0.2));
         scene.numerics.time_step_s = 0.1;
         return scene;
       }},
      {"corner_off_centre",
       [] {
         return wall_hit(floe(16.0, 6.0, {-8.5282, 0.0}, {0.5, 0.0}, 30.0));
       }},
      {"corner_slides",
       [] {
         return wall_hit(floe(10.0, 10.0, {-7.1711, 0.0}, {0.5, 0.2}, 45.0, 0.1), 0.3);
       }},
      {"tilt_1", [] { return tilted_face(1.0, 0.4); }},
      {"tilt_3", [] { return tilted_face(3.0, 0.7); }},
      {"two_floes", [] { return two_floes(0.0); }},
      {"two_rough_floes", [] { return two_floes(0.35); }},
      {"moored_platform", moored_platform},
      {"floe_of_2_m",
       [] {
         return wall_hit(floe(2.0, 2.0, {-1.45, 0.0}, {0.5, 0.0}, 40.0), 0.1);
       }},
  };
}

class CompliantAgrees : public testing::TestWithParam<Case> {};

/// `share`: of the largest force, the depths and the speeds; `time`: of the durations [s].
void expect_same_hits(const Hits& cpu, const Hits& reference, double share, double time) {
  EXPECT_NEAR(cpu.force, reference.force, share * reference.force);
  EXPECT_NEAR(cpu.depth, reference.depth, share * reference.depth);
  EXPECT_NEAR(cpu.sprung, reference.sprung, share * reference.sprung);
  EXPECT_NEAR(cpu.mean_force, reference.mean_force, share * reference.mean_force);
  EXPECT_NEAR(cpu.impulse, reference.impulse, share * reference.impulse);
  EXPECT_NEAR(cpu.duration, reference.duration, time);
  constexpr double speed = 0.5;  // of the floes before they hit [m/s]
  const Bodies &a = cpu.bodies, &b = reference.bodies;
  for (std::size_t i = 0; i < a.count(); ++i) {
    EXPECT_LT(length(a.velocity[i] - b.velocity[i]), share * speed) << "body " << i;
    EXPECT_LT(std::fabs(a.spin[i] - b.spin[i]) * a.radius[i], share * speed) << "body " << i;
  }
  expect_closed_books(cpu);
  expect_closed_books(reference);
}

/// The cpu engine as it runs. Its substeps and its limit of the damping show in how fast a corner springs back.
TEST_P(CompliantAgrees, WithinTwoPercent) {
  const SceneDef scene = GetParam().scene();
  const Hits cpu = run(scene, "cpu"), reference = run(scene, "reference");
  const double substep = scene.numerics.time_step_s / static_cast<double>(cpu.substeps);
  EXPECT_EQ(cpu.substeps, reference.substeps);
  ASSERT_GT(reference.mean_force, 1e4) << "nothing touched";
  ASSERT_GE(reference.duration, 12.0 * substep);
  expect_same_hits(cpu, reference, 0.02, 0.02 * reference.duration + substep);
}

/// The cpu engine with the substeps of the reference differs by rounding, and by what its time steps freeze.
TEST_P(CompliantAgrees, InTheSameSubsteps) {
  SceneDef scene = GetParam().scene();
  scene.numerics.substeps = 8 * run(scene, "cpu").substeps;
  ReferenceEngine engine(scene, make_field(scene), 1);
  const Hits cpu = run(scene, "cpu"), reference = run(scene, engine);
  EXPECT_EQ(cpu.substeps, reference.substeps);
  ASSERT_GT(reference.mean_force, 1e4) << "nothing touched";
  expect_same_hits(cpu, reference, 1e-9, 1e-9 * reference.duration);
}

INSTANTIATE_TEST_SUITE_P(Cases, CompliantAgrees, testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.name; });

/// The current presses floes on each other, on a wall beside them and on a moored platform.
SceneDef pressed_scene() {
  SceneDef scene = moored_platform();
  scene.run.duration_s = 10.0;
  scene.numerics.time_step_s = 0.05;
  scene.current.velocity_m_per_s = {0.6, -0.2};
  scene.water.drag_law = DragLaw::quadratic;
  scene.coriolis.parameter_per_s = 1.4e-4;
  scene.platform_drag.present = true;
  scene.ice.friction_ice = 0.35;
  scene.fixed = {{{{-60.0, -10.0}, {-14.0, -10.0}, {-14.0, -5.5}, {-60.0, -5.5}}}};
  scene.floe.push_back(floe(9.0, 8.0, {-29.5, -0.5}, {0.5, -0.2}, 5.0));
  scene.floe.push_back(floe(7.0, 8.0, {-29.0, 10.5}, {0.5, -0.3}, 33.0));
  return scene;
}

TEST(ReferenceCompliant, BooksClose) {
  const Hits hits = run(pressed_scene(), "reference");
  ASSERT_GT(hits.force, 1e4) << "the platform met no ice";
  ASSERT_LT(hits.ledger[Channel::friction].energy, 0.0);
  ASSERT_GT(length(hits.ledger[Channel::impact].momentum), 1.0) << "the wall met no ice";
  ASSERT_GT(hits.ledger.contact.crushed, 0.0);
  expect_closed_books(hits);
}

/// Loads of the floes: the cpu engine spreads those of a time step, the reference finds them anew in every substep.
TEST(ReferenceCompliant, LoadsActInEverySubstep) {
  SceneDef scene = pressed_scene();
  scene.run.duration_s = 6.0;
  scene.numerics.substeps = 8 * run(scene, "cpu").substeps;
  ReferenceEngine engine(scene, make_field(scene), 1);
  const Hits reference = run(scene, engine);
  ASSERT_GT(reference.force, 1e4) << "the platform met no ice";
  expect_same_hits(run(scene, "cpu"), reference, 2e-3, 0.01 * reference.duration);
}

/// A run that is saved while corners are loaded goes on with the same bits.
TEST(ReferenceCompliant, ARestartGivesTheSameBits) {
  SceneDef scene = two_floes(0.35);
  scene.numerics.time_step_s = 0.05;
  ReferenceEngine whole(scene, make_field(scene), 2), resumed(scene, make_field(scene), 2);
  StepLog log;
  EngineState state;
  for (int i = 0; i < 40 && state.corner_key.empty(); ++i) {
    whole.advance(1, log);
    state = whole.save();
  }
  ASSERT_FALSE(state.corner_key.empty()) << "nothing touched";
  ASSERT_GT(state.corner_value[0].normal, 0.0);
  ASSERT_NE(state.corner_value[0].stretch, 0.0);
  resumed.restore(state);
  whole.advance(10, log);
  resumed.advance(10, log);
  EXPECT_EQ(whole.state_hash(), resumed.state_hash());
  test::expect_same_bodies(whole.bodies(), resumed.bodies());
  EXPECT_EQ(residual(whole.ledger()).energy, residual(resumed.ledger()).energy);
  EXPECT_EQ(whole.ledger().contact.left(), resumed.ledger().contact.left());
}

/// The ice in front of a corner that overlaps at the start is crushed: it does not push.
TEST(ReferenceCompliant, AnOverlapAtTheStartIsCrushed) {
  const SceneDef scene = wall_hit(floe(10.0, 10.0, {-7.1, 0.0}, {0.0, 0.0}, 45.0), 0.0, 0.1);
  Bodies field = make_field(scene);
  field.position.back().x += 0.05;
  ReferenceEngine engine(scene, field);
  const Hits hits = run(scene, engine);
  ASSERT_FALSE(engine.save().corner_key.empty());
  EXPECT_EQ(hits.force, 0.0);
  EXPECT_EQ(hits.bodies.velocity.back().x, 0.0);
}

/// Two squares whose sides are in line, or off by less than they overlap, hit like others.
TEST(ReferenceCompliant, AlignedSquaresHit) {
  for (const double off : {0.0, 1e-10, 1e-8, 1e-3, 0.1}) {
    SceneDef scene = still_scene();
    scene.run.duration_s = 0.5;
    scene.floe = {floe(10.0, 10.0, {0.0, 0.0}, {0.5, 0.0}), floe(10.0, 10.0, {10.02, off}, {0.0, 0.0})};
    const Hits hits = run(scene, "reference");
    // the damping returns 0.30 of the speed
    EXPECT_NEAR(hits.bodies.velocity[1].x, 0.25 * (1.0 - 0.30), 1e-3) << off;
    EXPECT_NEAR(hits.bodies.velocity[2].x, 0.25 * (1.0 + 0.30), 1e-3) << off;
    expect_closed_books(hits);
  }
}

/// A floe that passes a wall with an overlap of 1 mm loses what the first corner crushes and no more: the last corner
/// of the passing side meets neither the side past which the floe reaches in, nor a spring that nothing has pressed.
TEST(ReferenceCompliant, TheEndOfAGrazingSideHitsNothing) {
  SceneDef scene = still_scene();
  scene.run.duration_s = 12.0;
  scene.numerics.time_step_s = 0.1;
  scene.fixed = {{{{0.0, -10.0}, {20.0, -10.0}, {20.0, 10.0}, {0.0, 10.0}}}};
  scene.floe = {floe(10.0, 10.0, {-5.333, -14.999}, {2.0, 0.0})};
  const Hits hits = run(scene, "reference");
  const ContactEnergy& e = hits.ledger.contact;
  ASSERT_GT(e.crushed, 0.1) << "nothing touched";
  EXPECT_GT(hits.bodies.velocity.back().x, 2.0 - 1e-3);
  EXPECT_LT(e.work, 0.0);
  EXPECT_LT(std::fabs(e.left()), 5.0);
}

/// Finer substeps change nothing: the differences to the cpu engine are not those of the reference.
TEST(ReferenceCompliant, ItsSubstepsAreShortEnough) {
  const SceneDef scene = tilted_face(3.0, 0.7);
  ReferenceEngine coarse(scene, make_field(scene)), fine(scene, make_field(scene), 32);
  const Hits a = run(scene, coarse), b = run(scene, fine);
  ASSERT_GT(a.force, 1e4);
  EXPECT_NEAR(a.force, b.force, 2e-3 * b.force);
  EXPECT_NEAR(a.depth, b.depth, 2e-3 * b.depth);
  EXPECT_NEAR(a.bodies.velocity.back().x, b.bodies.velocity.back().x, 1e-3);
}

TEST(ReferenceCompliant, RefusesAPlatformOfPieces) {
  SceneDef scene = test::pieces_scene(1);
  scene.contact.solver = ContactSolver::compliant;
  EXPECT_THROW(run(scene, "reference"), Error);
}

}  // namespace
}  // namespace gem
