// Outlines of platforms, loads by side, the fixed platform and heading control against closed form: V75 to V79.
#include <algorithm>
#include <cmath>

#include "gem/field/field.h"
#include "gem/geometry/polygon.h"
#include "gem/record/side_loads.h"
#include "gem/scene/platform_shape.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Outlines : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Outlines, ::testing::ValuesIn(all_settings()), setting_name);

/// A ship 200 m x 40 m of 7e7 kg without mooring.
SceneDef ship_scene() {
  SceneDef scene = quiet_scene();
  scene.platform.present = true;
  scene.platform.outline = PlatformOutline::ship;
  scene.platform.mass_kg = 7e7;
  scene.mooring.stiffness_N_per_m = 0.0;
  return scene;
}

/// A square floe whose face lies on the platform at `place` of its outline, and that moves against it.
FloeDef floe_on(const PlatformDef& platform, Vec2 place, Vec2 normal, double speed) {
  const Rotation yaw{std::cos(platform.start_yaw_rad), std::sin(platform.start_yaw_rad)};
  const Vec2 out = rotate(yaw, normal);
  const Vec2 centre = platform.anchor_m + rotate(yaw, place) + (5.0 - touch) * out;
  return square(centre, -speed * out, std::atan2(out.y, out.x));
}

struct OutlineSide {
  Vec2 middle, normal;
};

OutlineSide side_at(const std::vector<Vec2>& outline, std::size_t k) {
  const Vec2 a = outline[k], b = outline[(k + 1) % outline.size()];
  return {0.5 * (a + b), (1.0 / length(b - a)) * turned_right(b - a)};
}

TEST(ShipOutline, V75_area_centroid_and_inertia) {
  const SceneDef scene = ship_scene();
  const std::vector<Vec2> outline = platform_outline(scene.platform);
  const Bodies bodies = make_field(scene);
  check("V75.area", platform_area(scene.platform), rounding);
  check("V75.stem", -outline[0].x, rounding);
  check("V75.inertia", bodies.inertia[0], rounding);
  check_value("V75.sides", 11.0, static_cast<double>(outline.size()), 0.0, "-");
  EXPECT_EQ(first_non_convex_vertex(outline), -1);
  for (std::size_t k = 1; k < outline.size(); ++k)
    EXPECT_DOUBLE_EQ(outline[k].y, -outline[outline.size() - k].y) << "port and starboard, corner " << k;
}

TEST(ShipOutline, V75_a_flat_bow_without_stern_is_a_rectangle) {
  SceneDef scene = ship_scene();
  scene.platform.bow_length_m = scene.platform.stern_length_m = 0.0;
  const Bodies bodies = make_field(scene);
  ASSERT_EQ(bodies.vertex_count(0), 4);
  check_value("V75.rectangle", 7e7 * (200.0 * 200.0 + 40.0 * 40.0) / 12.0, bodies.inertia[0], rounding * 3e11, "kg m2");
}

/// The corner of a floe hits the port side 50 m aft of the centre; the floe's centre lies behind its corner, so only
/// the ship turns.
SceneDef hit_aft(SceneDef scene) {
  const double half_diagonal = 5.0 * std::sqrt(2.0);
  scene.floe = {square({50.0, -0.5 * scene.platform.beam_m - half_diagonal + touch}, {0.0, 0.5}, degrees(45.0))};
  return scene;
}

TEST_P(Outlines, V76_a_hit_aft_turns_the_ship) {
  const Impact impact = one_impact(hit_aft(ship_scene()), setting());
  check("V76.J", -impact.impulse(0).y, rounding, where());
  check("V76.V", impact.after.velocity[0].y, rounding, where());
  check("V76.omega", impact.after.spin[0], rounding, where());
}

TEST_P(Outlines, V76_the_inertia_may_be_given) {
  SceneDef scene = hit_aft(ship_scene());
  scene.platform.inertia_kg_m2 = 5e10;
  const Impact impact = one_impact(scene, setting());
  check("V76.given.J", -impact.impulse(0).y, rounding, where());
  check("V76.given.omega", impact.after.spin[0], rounding, where());
}

TEST_P(Outlines, V76_listed_corners_make_the_same_ship) {
  SceneDef listed = hit_aft(ship_scene());
  std::vector<Vec2> corners = platform_outline(listed.platform);
  for (Vec2& corner : corners) corner += {-31.0, 12.0};  // the centroid counts, not the origin
  std::reverse(corners.begin(), corners.end());
  listed.platform.outline = PlatformOutline::listed;
  listed.platform.outline_m = corners;
  const Impact impact = one_impact(listed, setting());
  // corners are rounded to 2e-14 m at 100 m from the origin, and so is the place of the side: 0x1p-40 m are left
  check("V76.J", -impact.impulse(0).y, rounding, where());
  check("V76.omega", impact.after.spin[0], 10.0 * rounding, where());
}

TEST_P(Outlines, V77_a_floe_gives_its_impulse_to_the_side_that_it_hits) {
  SceneDef scene = ship_scene();
  scene.platform.fixed = true;
  scene.platform.start_yaw_rad = 0.7;
  scene.platform.anchor_m = {3.0, -8.0};
  const std::vector<Vec2> outline = platform_outline(scene.platform);
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const OutlineSide side = side_at(outline, k);
    scene.floe = {floe_on(scene.platform, side.middle, side.normal, 0.5)};
    Simulation run = start(scene, setting());
    run.advance(1);
    SideLoads loads(outline);
    for (const ContactEvent& row : run.log.events)
      loads.add(row, run.log.platform[0].position, run.log.platform[0].rotation);
    for (std::size_t other = 0; other < outline.size(); ++other) {
      if (other == k)
        check("V77.J", loads.sums().normal[other], rounding, where());
      else
        EXPECT_EQ(loads.sums().normal[other], 0.0) << "hit side " << k << ", side " << other;
    }
  }
}

TEST_P(Outlines, V78_a_fixed_platform_takes_the_impulse_and_stays) {
  SceneDef scene = ship_scene();
  scene.platform.fixed = true;
  const OutlineSide side = side_at(platform_outline(scene.platform), 1);
  scene.floe = {floe_on(scene.platform, side.middle, side.normal, 0.5)};
  Simulation run = start(scene, setting());
  const Bodies before = run.bodies();
  run.advance(1);
  const PlatformStep& step = run.log.platform[0];
  check("V78.J", -dot(step.ice_impulse, side.normal), rounding, where());
  check("V78.J", dot(step.mooring_impulse, side.normal), rounding, where());
  EXPECT_EQ(run.bodies().position[0].x, before.position[0].x);
  EXPECT_EQ(run.bodies().position[0].y, before.position[0].y);
  EXPECT_EQ(run.bodies().rotation[0].sine, before.rotation[0].sine);
  EXPECT_EQ(length(run.bodies().velocity[0]), 0.0);
  EXPECT_EQ(run.bodies().spin[0], 0.0);
  expect_closed_books(run);
}

TEST_P(Outlines, V78_a_floe_rests_on_a_fixed_platform) {
  SceneDef scene = ship_scene();
  scene.platform.fixed = true;
  scene.platform.bow_length_m = 0.0;
  scene.current.velocity_m_per_s = {0.5, 0.0};
  scene.water.drag_law = DragLaw::quadratic;
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = 0.005;
  scene.numerics.time_step_s = 0.05;
  const std::vector<Vec2> outline = platform_outline(scene.platform);
  const OutlineSide bow = side_at(outline, outline.size() - 1);
  scene.floe = {floe_on(scene.platform, bow.middle, bow.normal, 0.0)};
  Simulation run = start(scene, setting());
  run.advance(400);
  Vec2 sum;
  SideLoads loads(outline);
  for (std::size_t i = 200; i < 400; ++i) sum += run.log.platform[i].ice_impulse;
  for (const ContactEvent& row : run.log.events)
    if (row.time > 199.5 * 0.05) loads.add(row, run.bodies().position[0], run.bodies().rotation[0]);
  // the drag on a floe at rest, as V30: k U dt, since drag and contact take turns
  const double k = 1025.0 * 0.005 / (900.0 * 0.5), tolerance = k * 0.5 * 0.05;
  check("V78.F", sum.x / 10.0, tolerance, where());
  check("V78.F", loads.sums().normal[outline.size() - 1] / 10.0, tolerance, where());
  expect_closed_books(run, 1e-12);
}

/// The ship with a heading control, alone in water that flows to +x.
SceneDef vaning_scene(double yaw, double damping, double dt) {
  SceneDef scene = ship_scene();
  scene.current.velocity_m_per_s = {0.25, 0.0};
  scene.platform.start_yaw_rad = yaw;
  scene.heading.moment_N_m = 8e7;
  scene.heading.damping_N_m_s = damping;
  scene.numerics.time_step_s = dt;
  return scene;
}

double yaw_of(const PlatformStep& step) { return std::atan2(step.rotation.sine, step.rotation.cosine); }

TEST_P(Outlines, V79_the_heading_swings_as_a_pendulum) {
  const double dt = 0.1;
  Simulation run = start(vaning_scene(degrees(60.0), 0.0, dt), setting());
  run.advance(1200);
  double fastest = 0.0;
  for (const PlatformStep& step : run.log.platform) fastest = std::max(fastest, std::fabs(step.spin));
  // kicks of second order, and the largest of samples at the ends of time steps
  const double order = value_of("V79.rate") * dt;
  check("V79.rate", fastest, order * order, where());
  expect_closed_books(run, 1e-12);
}

TEST_P(Outlines, V79_beyond_a_quarter_turn_the_moment_is_whole) {
  Simulation run = start(vaning_scene(2.5, 0.0, 0.1), setting());
  run.advance(500);
  check("V79.spin", -run.bodies().spin[0], rounding, where());
  // the turn is a chain of 500 rotations, each rounded to 1e-16, about an angle of 2.5 rad
  check("V79.angle", 2.5 - yaw_of(run.log.platform.back()), 1e-11, where());
}

TEST_P(Outlines, V79_the_heading_lags_behind_a_current_that_turns) {
  const double dt = 0.5, rate = 0.5 * M_PI / 3600.0;
  SceneDef scene = vaning_scene(0.0, 7.9e9, dt);
  scene.drive.current_direction = {{0.0, 0.25, 0.0}, {7200.0, 0.25, 7200.0 * rate}};
  Simulation run = start(scene, setting());
  run.advance(4000);
  // the damping of a time step acts in two halves about the moment: C dt / 2 I, second order
  const double order = 7.9e9 * dt / (2.0 * run.bodies().inertia[0]);
  check("V79.lag", 2000.0 * rate - yaw_of(run.log.platform.back()), order * order, where());
  expect_closed_books(run, 1e-12);
}

TEST_P(Outlines, V79_a_locked_yaw_is_not_steered) {
  SceneDef scene = vaning_scene(1.0, 7.9e9, 0.5);
  scene.platform.yaw = Yaw::locked;
  Simulation run = start(scene, setting());
  const Rotation before = run.bodies().rotation[0];
  run.advance(10);
  EXPECT_EQ(run.bodies().rotation[0].sine, before.sine);
  EXPECT_EQ(run.bodies().spin[0], 0.0);
}

}  // namespace
}  // namespace gem::verification
