// A platform of several convex pieces: V97 to V101. It moves as the same outline in one piece, ice slides over its
// joints, and a notch catches a floe.
#include <algorithm>
#include <cmath>

#include "gem/field/field.h"
#include "gem/scene/platform_shape.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Pieces : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Pieces, ::testing::ValuesIn(all_settings()), setting_name);
class CoupledPieces : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, CoupledPieces, ::testing::ValuesIn(coupled_settings()), setting_name);

std::vector<Vec2> box(Vec2 low, Vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

SceneDef platform_of(const std::vector<std::vector<Vec2>>& pieces) {
  SceneDef scene = quiet_scene();
  scene.platform.present = true;
  scene.platform.outline = PlatformOutline::pieces;
  for (const std::vector<Vec2>& piece : pieces) scene.platform.piece.push_back({piece});
  scene.platform.mass_kg = 4e5;
  scene.mooring.stiffness_N_per_m = 0.0;
  return scene;
}

/// 20 m x 20 m about the origin, in one piece or cut at x = 0.
SceneDef square_platform(bool is_cut) {
  if (is_cut) return platform_of({box({-10.0, -10.0}, {0.0, 10.0}), box({0.0, -10.0}, {10.0, 10.0})});
  return platform_of({box({-10.0, -10.0}, {10.0, 10.0})});
}

/// Three sides of 10 m wide walls round a notch 20 m wide and 20 m deep, open to -x.
SceneDef notched_platform() {
  return platform_of(
      {box({0.0, -20.0}, {10.0, 20.0}), box({-20.0, 10.0}, {0.0, 20.0}), box({-20.0, -20.0}, {0.0, -10.0})});
}

std::size_t first_floe_of(const Bodies& b) {
  return static_cast<std::size_t>(std::find(b.kind.begin(), b.kind.end(), BodyKind::floe) - b.kind.begin());
}

TEST(PieceOutlines, V97_area_centroid_and_inertia_of_all_pieces) {
  // three squares of 10 m: J = 3 a^4 / 6 + a^2 sum of the squared distances of their centres from the common one
  SceneDef scene = platform_of({box({0.0, 0.0}, {20.0, 10.0}), box({0.0, 10.0}, {10.0, 20.0})});
  scene.platform.anchor_m = {3.0, 4.0};
  const Bodies b = make_field(scene);
  check_value("V97.area", 300.0, platform_area(scene.platform), 300.0 * rounding, "m2");
  check_value("V97.inertia", 4e5 * (5e3 + 4e4 / 3.0) / 300.0, b.inertia[0], 3e7 * rounding, "kg m2");
  check_value("V97.corner", -25.0 / 3.0, b.vertex[0].x, 10.0 * rounding, "m");
  check_value("V97.radius", std::hypot(35.0, 25.0) / 3.0, b.radius[1], 10.0 * rounding, "m");
  EXPECT_EQ(platform_bodies(b), 2);
  EXPECT_EQ(b.mass[1], 0.0);
  EXPECT_EQ(b.inverse_mass[1], b.inverse_mass[0]);
  EXPECT_NEAR(b.position[1].x, 3.0, 1e-13);
}

/// The largest difference of the motion of both platforms and floes during a run [m].
double apart(const SceneDef& one, const SceneDef& other, const Setting& setting, std::int64_t steps) {
  Simulation p = start(one, setting), q = start(other, setting);
  double difference = 0.0;
  std::int64_t contacts = 0;
  for (std::int64_t step = 0; step < steps; ++step) {
    p.advance(1);
    q.advance(1);
    contacts += p.log.quality.back().contacts;
    const Bodies &a = p.bodies(), &b = q.bodies();
    const std::size_t floe_a = first_floe_of(a), floe_b = first_floe_of(b);
    const auto compare = [&](std::size_t i, std::size_t j) {
      const Vec2 turned{a.rotation[i].cosine - b.rotation[j].cosine, a.rotation[i].sine - b.rotation[j].sine};
      difference = std::max({difference, length(a.position[i] - b.position[j]), a.radius[i] * length(turned)});
    };
    compare(0, 0);
    for (std::size_t k = 0; floe_a + k < a.count(); ++k) compare(floe_a + k, floe_b + k);
  }
  EXPECT_GT(contacts, 0) << "the bodies never touched";
  expect_closed_books(p, 1e-12);
  expect_closed_books(q, 1e-12);
  return difference;
}

/// A square floe that comes down on the upper side at `x` with a spin, and turns the platform.
SceneDef hit_from_above(SceneDef scene, double x) {
  scene.numerics.time_step_s = 0.01;
  scene.numerics.repair_share = 0.6;
  scene.ice.friction_structure = 0.3;
  scene.floe = {square({x, 15.005}, {0.2, -0.5})};
  return scene;
}

TEST_P(Pieces, V98_a_square_in_two_halves_moves_as_one_square) {
  // the face of the floe meets one half; both see the same corners, but for the rounding of the common centroid. Each
  // of 300 time steps adds a few roundings of 15 m, and the solver its residual of 1e-14 of the speed.
  const double difference =
      apart(hit_from_above(square_platform(true), 5.5), hit_from_above(square_platform(false), 5.5), setting(), 300);
  check_value("V98.apart", 0.0, difference, 1e-10, "m", where());
}

TEST_P(CoupledPieces, V99_a_floe_across_the_joint_gives_the_impulse_of_one_square) {
  SceneDef cut = square_platform(true), whole = square_platform(false);
  for (SceneDef* scene : {&cut, &whole}) scene->floe = {square({1.5, 15.0 - touch}, {0.2, -0.5})};
  const Impact on_cut = one_impact(cut, setting()), on_whole = one_impact(whole, setting());
  // two plastic points of each piece hold the face: the motion is unique, the impulses of the points are not
  check_value("V99.J", on_whole.impulse(0).y, on_cut.impulse(0).y, 1e-9 * on_whole.impulse(0).y, "N s", where());
  check_value("V99.V", on_whole.after.velocity[0].y, on_cut.after.velocity[0].y, 1e-10, "m/s", where());
  check_value("V99.omega", on_whole.after.spin[0], on_cut.after.spin[0], 1e-11, "rad/s", where());
}

TEST_P(CoupledPieces, V100_ice_slides_over_a_joint) {
  for (const double angle : {0.0, 45.0, 20.0}) {  // on its face, on a corner, on a corner askew
    SceneDef scene = square_platform(true);
    scene.platform.fixed = true;
    scene.numerics.time_step_s = 0.01;
    FloeDef floe = on_floor(square({-2.0, 0.0}, {0.5, 0.0}, degrees(angle)));
    floe.position_m.y += 10.0;
    scene.floe = {floe};
    Simulation run = start(scene, setting());
    std::int64_t contacts = 0;
    for (int step = 0; step < 800; ++step) {  // 4 m
      run.advance(1);
      contacts += run.log.quality.back().contacts;
    }
    EXPECT_GT(contacts, 400) << "the floe left the platform";
    const Bodies& b = run.bodies();
    const std::size_t i = first_floe_of(b);
    // it has touched all the way, and nothing has pressed on it
    check_value("V100.u", 0.5, b.velocity[i].x, rounding, "m/s", where());
    check_value("V100.x", 2.0, b.position[i].x, 1e-10, "m", where());
    check_value("V100.v", 0.0, b.velocity[i].y, rounding, "m/s", where());
  }
}

TEST_P(CoupledPieces, V101_a_notch_catches_a_floe) {
  SceneDef scene = notched_platform();
  scene.numerics.time_step_s = 0.01;
  scene.numerics.repair_share = 0.6;
  scene.floe = {{rectangle(10.0, 20.0 - 2.0 * touch), {-5.2, 0.0}, 0.0, {0.6, 0.0}, 0.0, 0.5}};
  Simulation run = start(scene, setting());
  double overlap = 0.0;
  std::int32_t contacts = 0;
  for (int step = 0; step < 1000; ++step) {
    run.advance(1);
    overlap = std::max(overlap, run.log.quality.back().maximum_overlap);
    contacts = std::max(contacts, run.log.quality.back().contacts);
  }
  const Bodies& b = run.bodies();
  const std::size_t i = first_floe_of(b);
  EXPECT_GE(contacts, 2);
  const double common = b.mass[i] * 0.6 / (b.mass[i] + 4e5);
  check_value("V101.platform", common, b.velocity[0].x, rounding, "m/s", where());
  check_value("V101.floe", common, b.velocity[i].x, rounding, "m/s", where());
  check_value("V101.spin", 0.0, b.spin[i], rounding, "rad/s", where());
  // the platform has moved with its old velocity for half of the time step in which the floe meets it
  check_value("V101.overlap", 0.5 * common * 0.01, overlap, 1e-9, "m", where());
  // its face lies on the bottom of the notch, 2.5 m from the centroid: 400 m2 at x = 5, twice 200 m2 at x = -10
  check_value("V101.distance", 2.5 - 5.0, b.position[i].x - b.position[0].x, 1e-9, "m", where());
  expect_closed_books(run, 1e-12);
}

}  // namespace
}  // namespace gem::verification
