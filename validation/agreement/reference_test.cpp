// The reference engine judges the cpu engine: the same scene, the same laws, and nothing else in common.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "gem/engine/testing/test_scenes.h"
#include "gem/events/crushing.h"
#include "gem/field/field.h"
#include "validation/agreement/comparison.h"
#include "validation/agreement/jam.h"

namespace gem {
namespace {

using agreement::compare;
using agreement::Comparison;
using agreement::floe;
using agreement::still_scene;

/// How contacts are solved, for tests that take all combinations.
struct Way {
  ContactSolver solver;
  Manifold manifold;
  double friction;
  FrictionLaw law;
};

std::string name_of(const Way& way) {
  std::string name = way.solver == ContactSolver::coupled ? "coupled" : "independent";
  name += way.manifold == Manifold::chord_ends ? "_ends" : "_middle";
  if (way.friction == 0.0) return name + "_smooth";
  return name + (way.law == FrictionLaw::one_step ? "_one_step" : "_fixed_direction");
}

void PrintTo(const Way& way, std::ostream* out) { *out << name_of(way); }

std::vector<Way> all_ways() {
  std::vector<Way> ways;
  for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled})
    for (const Manifold manifold : {Manifold::chord_middle, Manifold::chord_ends}) {
      ways.push_back({solver, manifold, 0.0, FrictionLaw::one_step});
      for (const FrictionLaw law : {FrictionLaw::one_step, FrictionLaw::fixed_direction})
        ways.push_back({solver, manifold, 0.3, law});
    }
  return ways;
}

std::vector<Way> ways_with_faces() {
  std::vector<Way> ways = all_ways();
  std::erase_if(ways, [](const Way& w) { return name_of(w) == "independent_ends_fixed_direction"; });
  return ways;
}

class ReferenceJudges : public testing::TestWithParam<Way> {
 protected:
  SceneDef scene() const {
    SceneDef scene = still_scene();
    scene.contact.solver = GetParam().solver;
    scene.contact.manifold = GetParam().manifold;
    scene.contact.friction_law = GetParam().law;
    scene.ice.friction_ice = scene.ice.friction_structure = GetParam().friction;
    return scene;
  }
  bool coupled() const { return GetParam().solver == ContactSolver::coupled; }
};

/// Faces that touch in two points. `independent` with fixed_direction is left out: there the cpu engine takes the
/// direction of one point's friction from the motion after the other point's impulse; the reference takes it from the
/// motion before the event, as the law says.
class ReferenceJudgesFaces : public ReferenceJudges {};

/// Two faces flat on each other, off centre.
TEST_P(ReferenceJudgesFaces, TwoFloes) {
  SceneDef s = scene();
  s.floe = {floe(10.0, 10.0, {0.0, 0.0}, {0.4, 0.1}), floe(10.0, 8.0, {10.2, 1.5}, {-0.3, -0.05}, 0.0, 0.0)};
  compare({.scene = s, .steps = 60, .row = 1});
}

/// A corner on a face; both floes turn.
TEST_P(ReferenceJudges, TwoTurningFloes) {
  SceneDef s = scene();
  s.floe = {floe(12.0, 9.0, {0.0, 0.0}, {0.4, 0.0}, 0.3, 0.02), floe(10.0, 8.0, {13.0, 2.0}, {-0.3, 0.1}, 0.9, -0.03)};
  compare({.scene = s, .steps = 200, .row = 1, .anew = coupled()});
}

/// Drag presses a floe against a moored and damped platform.
TEST_P(ReferenceJudges, AFloeOnTheMooredPlatform) {
  SceneDef s = scene();
  s.current.velocity_m_per_s = {0.5, 0.1};
  s.water.drag_law = DragLaw::quadratic;
  s.platform.present = true;
  s.platform.diameter_m = 20.0;
  s.platform.mass_kg = 2e6;
  s.platform.start_velocity_m_per_s = {0.0, 0.05};
  s.mooring.stiffness_N_per_m = 2e5;
  s.mooring.damping_ratio = 0.05;
  s.platform_drag.present = true;
  s.floe = {floe(12.0, 9.0, {-17.0, 1.0}, {0.5, 0.0}, 0.2, 0.0)};
  std::size_t events = 0;
  Comparison c{.scene = s, .steps = 200, .row = 2, .anew = coupled()};
  c.also = [&](const StepLog& log) { events += log.events.size(); };
  compare(c);
  EXPECT_GT(events, 0u);
}

/// The current presses three floes in line against a wall, one of them turned.
TEST_P(ReferenceJudgesFaces, ThreeFloesInLineAgainstAWall) {
  SceneDef s = scene();
  s.current.velocity_m_per_s = {0.5, 0.0};
  s.water.drag_law = DragLaw::linear;
  s.water.linear_time_s = 20.0;
  s.fixed = {{{{20.0, -20.0}, {30.0, -20.0}, {30.0, 20.0}, {20.0, 20.0}}}};
  s.floe = {floe(10.0, 10.0, {14.9, 0.0}, {0.5, 0.0}), floe(9.0, 7.0, {5.0, 0.5}, {0.5, 0.0}, 0.1),
            floe(8.0, 9.0, {-4.5, -0.4}, {0.5, 0.0}, -0.05)};
  compare({.scene = s, .steps = 60, .row = 3, .anew = true});
}

/// Floes between the sides of a narrowing channel.
TEST_P(ReferenceJudges, AFloeOnTheBoundary) {
  SceneDef s = scene();
  s.current.velocity_m_per_s = {0.5, 0.0};
  s.water.drag_law = DragLaw::quadratic;
  s.boundary.present = true;
  s.boundary.inlet_x_m = s.boundary.taper_start_x_m = -60.0;
  s.boundary.inlet_width_m = 40.0;
  s.boundary.gap_m = 12.0;
  s.boundary.outlet_x_m = 20.0;
  s.floe = {floe(10.0, 8.0, {-32.0, 6.5}, {0.4, 0.3}, 0.2, 0.01), floe(9.0, 7.0, {-31.0, -6.0}, {0.4, -0.3}, 0.5, 0.0)};
  compare({.scene = s, .steps = 300, .row = 2, .anew = coupled()});
}

/// Overlap at the start: elastic stress if independent, position repair if coupled.
TEST_P(ReferenceJudgesFaces, OverlapIsTakenBack) {
  SceneDef s = scene();
  s.contact.elastic_stiffness_N_per_m = 1e6;
  s.floe = {floe(10.0, 10.0, {0.0, 0.0}, {0.1, 0.0}), floe(10.0, 8.0, {10.2, 1.5}, {0.0, 0.02})};
  compare({.scene = s, .steps = 20, .row = 1, .push = {-0.23, 0.0}});
}

const auto way_name = [](const auto& way) { return name_of(way.param); };
INSTANTIATE_TEST_SUITE_P(Ways, ReferenceJudges, testing::ValuesIn(all_ways()), way_name);
INSTANTIATE_TEST_SUITE_P(Ways, ReferenceJudgesFaces, testing::ValuesIn(ways_with_faces()), way_name);

/// A fast floe crushes against the platform over several time steps, from the step in which it hits.
void compare_crushing(Manifold manifold, double exponent, double friction) {
  constexpr double area = 12.0 * 9.0;
  SceneDef s = still_scene();
  s.contact.manifold = manifold;
  s.contact.crushing_limit = true;
  s.ice.crushing_pressure_Pa = 2e4;
  s.ice.pressure_area_exponent = exponent;
  s.ice.friction_structure = friction;
  s.numerics.iteration = Iteration::gradient;  // splitting ends at 1e-6 of the speed where a crushing bound holds
  s.platform.present = true;
  s.platform.diameter_m = 20.0;
  s.platform.mass_kg = 2e6;
  s.floe = {floe(12.0, 9.0, {-17.0, 1.0}, {2.0, 0.0}, 0.2)};
  const double cap = crushing_force({2e4, exponent, 0.5}, std::sqrt(area)) * agreement::dt;
  const auto pressed = [](const StepLog& log) { return log.events.empty() ? 0.0 : log.events.back().impulse_normal; };
  int at_cap = 0;
  Comparison c{.scene = s, .steps = 30, .anew = true};
  c.also = [&](const StepLog& log) {
    if (pressed(log) > (1.0 - 1e-9) * cap) ++at_cap;
    EXPECT_LE(pressed(log), (1.0 + 1e-9) * cap);
  };
  compare(c);
  EXPECT_GE(at_cap, 5);
}

TEST(ReferenceJudgesCrushing, TheCapHolds) {
  for (const double friction : {0.0, 0.3}) {
    compare_crushing(Manifold::chord_middle, -0.1, friction);
    compare_crushing(Manifold::chord_ends, -0.1, friction);
    compare_crushing(Manifold::chord_ends, 0.0, friction);
  }
}

/// Forty floes with random velocities in a channel that narrows to a moored platform. Every time step starts from the
/// same state in both engines.
SceneDef pack_scene(ContactSolver solver, Manifold manifold, double friction) {
  SceneDef scene = test::busy_scene(21);
  scene.floes.count = 40;
  scene.floes.length_m = 70.0;
  scene.floes.width_m = 50.0;
  scene.floes.start_x_m = -81.0;
  scene.boundary.inlet_x_m = scene.boundary.taper_start_x_m = -100.0;
  scene.boundary.inlet_width_m = 60.0;
  scene.boundary.gap_m = 30.0;
  scene.output.retire_x_m = 0.0;
  scene.contact.solver = solver;
  scene.contact.manifold = manifold;
  scene.contact.crushing_limit = false;
  scene.ice.friction_ice = scene.ice.friction_structure = friction;
  scene.numerics.residual_tolerance = 1e-12;
  scene.numerics.iterations_maximum = 200000;
  return scene;
}

void compare_pack(ContactSolver solver, Manifold manifold, double friction) {
  Comparison c{.scene = pack_scene(solver, manifold, friction), .steps = 400, .row = 8};
  c.contacts_of_a_body = 10;
  c.anew = c.thrown = true;
  c.contacts = 1000;
  int on_platform = 0;
  c.also = [&](const StepLog& log) { on_platform += log.platform[0].contacts; };
  compare(c);
  EXPECT_GT(on_platform, 20);
}

TEST(ReferenceJudgesAPack, CoupledWithoutFriction) {
  for (const Manifold manifold : {Manifold::chord_middle, Manifold::chord_ends})
    compare_pack(ContactSolver::coupled, manifold, 0.0);
}

/// Friction this low cannot hold a floe between two others by itself, so there is one answer.
TEST(ReferenceJudgesAPack, CoupledWithLowFriction) {
  for (const Manifold manifold : {Manifold::chord_middle, Manifold::chord_ends})
    compare_pack(ContactSolver::coupled, manifold, 0.1);
}

TEST(ReferenceJudgesAPack, Independent) {
  for (const double friction : {0.0, 0.35}) compare_pack(ContactSolver::independent, Manifold::chord_middle, friction);
}

/// 1,234 floes with about a thousand touching points, without friction. No push goes through more than the 60 floes
/// that fit between the upstream end and the platform.
void compare_jam(ContactSolver solver, Manifold manifold) {
  SceneDef scene = agreement::jam_scene(solver);
  scene.ice.friction_ice = scene.ice.friction_structure = 0.0;
  scene.contact.manifold = manifold;
  scene.contact.crushing_limit = false;
  const EngineState start = agreement::jam(scene, agreement::drifting_field(scene));
  scene.numerics.residual_tolerance = 1e-11;
  scene.numerics.iterations_maximum = 200000;
  Comparison c{.scene = scene, .steps = 3, .row = 60};
  c.contacts_of_a_body = 12;  // of the platform
  c.anew = true;
  c.contacts = 3 * agreement::contacts_wanted;
  c.start = &start;
  compare(c);
}

TEST(ReferenceJudgesAJam, Independent) { compare_jam(ContactSolver::independent, Manifold::chord_middle); }
TEST(ReferenceJudgesAJam, CoupledInOnePointEach) { compare_jam(ContactSolver::coupled, Manifold::chord_middle); }
TEST(ReferenceJudgesAJam, CoupledInTwoPointsEach) { compare_jam(ContactSolver::coupled, Manifold::chord_ends); }

TEST(ReferenceJudgesMotion, EachDragLaw) {
  for (const DragLaw law : {DragLaw::none, DragLaw::quadratic, DragLaw::linear})
    for (const bool spin_drag : {false, true}) {
      SceneDef s = still_scene();
      s.current.velocity_m_per_s = {0.5, 0.1};
      s.water.drag_law = law;
      s.water.spin_drag = spin_drag;
      s.floe = {floe(12.0, 9.0, {0.0, 0.0}, {0.4, 0.0}, 0.3, 0.02),
                floe(10.0, 8.0, {40.0, 2.0}, {-0.3, 0.1}, 0.9, -0.3)};
      compare({.scene = s, .steps = 400, .contacts = 0});
    }
}

TEST(ReferenceJudgesMotion, ThePlatformSwings) {
  for (const DampingWater water : {DampingWater::still, DampingWater::current}) {
    SceneDef s = still_scene();
    s.current.velocity_m_per_s = {0.5, 0.1};
    s.platform.present = true;
    s.platform.start_offset_m = {1.0, -2.0};
    s.platform.anchor_m = {3.0, 4.0};
    s.mooring.damping_ratio = 0.02;
    s.platform_drag.present = true;
    s.platform_drag.water = water;
    compare({.scene = s, .steps = 400, .contacts = 0});
  }
}

TEST(ReferenceJudgesMotion, CurrentAndWindThatChange) {
  for (const DampingWater water : {DampingWater::still, DampingWater::current}) {
    const SceneDef driven = test::driven_scene(1);
    SceneDef s = still_scene();
    s.water = driven.water;
    s.drive = driven.drive;
    s.wind = driven.wind;
    s.coriolis = driven.coriolis;
    s.platform.present = true;
    s.platform.start_offset_m = {1.0, -2.0};
    s.platform_drag.present = true;
    s.platform_drag.water = water;
    s.floe = {floe(12.0, 9.0, {-100.0, 0.0}, {0.4, 0.0}, 0.3, 0.02),
              floe(10.0, 8.0, {-140.0, 2.0}, {-0.3, 0.1}, 0.9, -0.3)};
    compare({.scene = s, .steps = 400, .contacts = 0});
  }
}

/// Floes hit a ship, steered or fixed, on its bow and beside it.
TEST(ReferenceJudgesMotion, AShipIsHitOnTwoSides) {
  for (const bool fixed : {false, true}) {
    SceneDef s = still_scene();
    s.platform = test::ship_scene(1, fixed).platform;
    s.platform.start_velocity_m_per_s = {};
    s.platform.anchor_m = s.platform.start_offset_m = {};
    s.platform.start_yaw_rad = 0.0;
    s.platform.present = true;
    s.platform.mass_kg = 4e5;
    s.platform.inertia_kg_m2 = 4e7;
    s.heading = {2e6, 1e7};
    s.current.velocity_m_per_s = {0.3, 0.1};  // without drag it only says where the bow should point
    s.floe = {floe(10.0, 9.0, {-26.0, 1.0}, {0.8, 0.0}, 0.3), floe(9.0, 7.0, {6.0, 12.0}, {0.0, -0.65}, 0.1)};
    compare({.scene = s, .steps = 300, .row = 2, .anew = true});
  }
}

/// Two floes hit a ship that drifts and turns, with water drag by axis: free, on a spring and on a mooring of tables.
TEST(ReferenceJudgesMotion, AShipIsDraggedByAxis) {
  for (const Yaw yaw : {Yaw::free, Yaw::locked})
    for (const MooringLaw law : {MooringLaw::linear, MooringLaw::table}) {
      SceneDef s = still_scene();
      s.platform = test::ship_scene(1, false).platform;
      s.platform.anchor_m = s.platform.start_offset_m = {};
      s.platform.start_yaw_rad = 0.0;
      s.platform.start_velocity_m_per_s = {-0.2, 0.1};
      s.platform.start_spin_rad_per_s = yaw == Yaw::free ? 0.02 : 0.0;
      s.platform.yaw = yaw;
      s.platform.present = true;
      s.platform.mass_kg = 4e5;
      s.platform.inertia_kg_m2 = yaw == Yaw::free ? 4e7 : 0.0;
      s.platform_drag = {
          .present = true, .draft_m = 5.0, .water = DampingWater::current, .law = PlatformDragLaw::by_axis};
      s.current.velocity_m_per_s = {0.3, 0.1};
      if (law == MooringLaw::table) {
        s.mooring = test::moored_scene(1).mooring;
        s.mooring_design = test::moored_scene(1).mooring_design;
      } else {
        s.mooring.stiffness_N_per_m = 1e4;
      }
      s.floe = {floe(10.0, 9.0, {-26.0, 1.0}, {0.8, 0.0}, 0.3), floe(9.0, 7.0, {6.0, 12.0}, {0.0, -0.65}, 0.1)};
      compare({.scene = s, .steps = 300, .row = 2, .anew = true});
    }
}

TEST(ReferenceJudgesMotion, MooringOfTablesWithYaw) {
  for (const Yaw yaw : {Yaw::free, Yaw::locked}) {
    SceneDef s = still_scene();
    s.mooring = test::moored_scene(1).mooring;
    s.mooring_design = test::moored_scene(1).mooring_design;
    s.platform.present = true;
    s.platform.mass_kg = 4e6;
    s.platform.yaw = yaw;
    s.platform.start_yaw_rad = 0.2;
    s.platform.start_offset_m = {1.0, -2.0};
    s.platform_drag.present = true;
    compare({.scene = s, .steps = 400, .contacts = 0});
  }
}

TEST(ReferenceJudgesMotion, ThrustersHoldThePlatform) {
  SceneDef s = still_scene();
  s.dp = test::dp_scene(1).dp;
  s.current.velocity_m_per_s = {0.3, 0.1};  // without drag it only says where the bow should point
  s.platform.present = true;
  s.platform.mass_kg = 4e6;
  s.platform.inertia_kg_m2 = 4e9;
  s.platform.start_yaw_rad = 0.2;
  s.platform.start_velocity_m_per_s = {0.3, 0.1};
  s.platform_drag.present = true;
  compare({.scene = s, .steps = 400, .contacts = 0});
}

/// A ship of 30 m, two floes ahead of it.
SceneDef ship_before_two_floes() {
  SceneDef s = still_scene();
  s.platform.present = true;
  s.platform.outline = PlatformOutline::ship;
  s.platform.length_m = 30.0;
  s.platform.beam_m = 9.0;
  s.platform.bow_length_m = 8.0;
  s.platform.stern_length_m = 5.0;
  s.platform.mass_kg = 4e6;
  s.platform.anchor_m = s.platform.start_offset_m = s.platform.start_velocity_m_per_s = {};
  s.mooring = {.stiffness_N_per_m = 0.0, .damping_ratio = 0.0};
  s.floe = {floe(10.0, 9.0, {-26.0, 1.0}, {}, 0.3), floe(9.0, 7.0, {-39.0, 8.0}, {}, 0.1)};
  return s;
}

TEST(ReferenceJudgesMotion, AShipIsLedThroughTwoFloes) {
  SceneDef s = ship_before_two_floes();
  s.platform_drag.present = true;
  s.transit = {.speed_m_per_s = 1.0, .way_point_m = {{-10.0, 0.0}, {-60.0, 20.0}}, .turn_radius_m = 25.0};
  compare({.scene = s, .steps = 400, .row = 2, .anew = true});
}

TEST(ReferenceJudgesMotion, AShipRunsFreeThroughTwoFloes) {
  SceneDef s = ship_before_two_floes();
  s.transit = {.speed_m_per_s = 1.0, .course_rad = 3.1, .bollard_thrust_N = 1e5, .open_water_speed_m_per_s = 1.5};
  compare({.scene = s, .steps = 400, .row = 2, .anew = true});
}

TEST(ReferenceJudgesMotion, LinesBreak) {
  SceneDef s = still_scene();
  const SceneDef lines = test::lines_scene(1);
  s.mooring = lines.mooring;
  s.mooring_design = lines.mooring_design;
  s.platform.present = true;
  s.platform.mass_kg = 4e6;
  s.platform.anchor_m = lines.platform.anchor_m;
  s.platform.start_offset_m = lines.platform.start_offset_m;
  s.platform.start_velocity_m_per_s = {0.3, 0.1};
  compare({.scene = s, .steps = 400, .contacts = 0});
  const auto cpu = make_engine(s, make_field(s), {});
  StepLog log;
  cpu->advance(400, log);
  EXPECT_NE(cpu->broken_lines(), 0U);
}

/// Two floes that wind and a turning current press against a wall.
TEST(ReferenceJudgesMotion, ATurningCurrentPressesOnAWall) {
  SceneDef s = still_scene();
  s.drive = test::driven_scene(1).drive;
  s.wind.form_coefficient = 0.5;
  s.water.drag_law = DragLaw::quadratic;
  s.water.turning_rad = 0.4;
  s.fixed = {{{{20.0, -20.0}, {30.0, -20.0}, {30.0, 20.0}, {20.0, 20.0}}}};
  s.floe = {floe(10.0, 10.0, {14.0, 0.0}, {0.5, 0.0}, 0.2), floe(9.0, 7.0, {3.5, 0.5}, {0.5, 0.0}, 0.1)};
  compare({.scene = s, .steps = 100, .row = 2, .anew = true});
}

/// 300 time steps of a pack with the reference alone, in blocks of `block`, with or without events.
std::uint64_t hash_of_pack(const SceneDef& scene, int block, bool events, bool restarts) {
  auto engine = make_engine(scene, test::busy_field(scene), agreement::on("reference"));
  StepLog log;
  log.wants_events = events;
  for (int done = 0; done < 300; done += block) {
    engine->advance(block, log);
    if (!restarts) continue;
    const EngineState state = engine->save();
    engine = make_engine(scene, test::busy_field(scene), agreement::on("reference"));
    engine->restore(state);
  }
  EXPECT_GT(test::contacts_in(log), 1000);
  EXPECT_EQ(log.events.empty(), !events) << "on the platform";
  return engine->state_hash();
}

TEST(ReferenceRepeats, ItsBitsWhateverTheBlocksTheLogAndRestarts) {
  for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled}) {
    const SceneDef scene = pack_scene(solver, Manifold::chord_ends, 0.35);
    const std::uint64_t whole = hash_of_pack(scene, 300, true, false);
    EXPECT_EQ(hash_of_pack(scene, 300, false, false), whole) << "events not logged";
    EXPECT_EQ(hash_of_pack(scene, 10, true, false), whole) << "in blocks";
    EXPECT_EQ(hash_of_pack(scene, 60, true, true), whole) << "restarted";
  }
}

}  // namespace
}  // namespace gem
