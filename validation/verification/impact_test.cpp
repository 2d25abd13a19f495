// Plastic impact without friction against closed form: V04 to V09 and V11 to V15.
#include <cmath>

#include "gem/events/events.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Impacts : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Impacts, ::testing::ValuesIn(all_settings()), setting_name);

/// Tests of the coupled solver only: it iterates.
class Iterations : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Iterations, ::testing::ValuesIn(coupled_settings()), setting_name);

TEST_P(Impacts, V04_flat_onto_a_wall) {
  const Impact impact = one_impact(over_floor(square({}, {0.0, -0.5})), setting());
  check("V04.J", impact.impulse(0).y, rounding, where());
  check("V04.dE", impact.energy_lost(), rounding, where());
  check("V04.dE", -impact.ledger[Channel::impact].energy, rounding, where());
  check_value("V04.v", 0.0, impact.velocity(0).y, 0.5 * rounding, "m/s", where());
  // A remaining speed s at the end of a face, 5 m from the centre, is a spin of s / 5 m.
  check_value("V04.omega", 0.0, impact.spin(0), 0.1 * rounding, "rad/s", where());
}

TEST_P(Impacts, V05_two_floes_in_line) {
  SceneDef scene = quiet_scene();
  FloeDef small = square({8.0 - touch, 0.0}, {-0.2, 0.0});
  small.outline_m = rectangle(6.0, 6.0);
  scene.floe = {square({}, {0.6, 0.0}), small};
  const Impact impact = one_impact(scene, setting());
  check("V05.v", impact.velocity(0).x, rounding, where());
  check("V05.v", impact.velocity(1).x, rounding, where());
  check("V05.J", impact.impulse(1).x, rounding, where());
  check("V05.dE", impact.energy_lost(), rounding, where());
}

TEST(ImpactLaw, V06_mass_reduction_of_a_corner) {
  const FloeDef floe = square({}, {}, degrees(30.0));
  const Vec2 arm = lowest_corner(floe), normal{0.0, 1.0};
  const double mass = 45000.0, inertia = 750000.0;
  check("V06.eta", cross(arm, normal), rounding);
  check("V06.ry", arm.y, rounding);
  check("V06.R", mass_reduction_factor(normal, arm, inertia / mass), rounding);
  check("V06.Me", 1.0 / contact_compliance({}, {}, {1.0 / mass, 1.0 / inertia}, arm, normal).nn, rounding);
}

TEST_P(Impacts, V06_corner_on_a_wall) {
  const Impact impact = one_impact(over_floor(square({}, {0.0, -0.5}, degrees(30.0))), setting());
  check("V06.J", impact.impulse(0).y, rounding, where());
  check("V06.vy", impact.velocity(0).y, rounding, where());
  check("V06.omega", impact.spin(0), rounding, where());
  check("V06.dE", impact.energy_lost(), rounding, where());
}

TEST_P(Impacts, V06_corner_on_a_wall_seen_as_a_chord) {
  SceneDef scene = over_floor(square({}, {0.0, -0.5}, degrees(30.0)));
  scene.contact.manifold = Manifold::chord_middle;
  const double depth = 5e-7;
  scene.floe[0].position_m.y -= depth;
  const Impact impact = one_impact(scene, setting());
  // The middle of the chord lies up to depth x cot(30 deg) = 1.7 depth beside the corner, so eta is wrong by that much.
  // The impulse follows with 2 eta / (k2 R) = 0.18 per metre. The normal of a chord of 2.3 depth turns by rounding /
  // chord.
  const double tolerance = 2.0 * depth;
  check("V06.J", impact.impulse(0).y, tolerance, where());
  check("V06.omega", impact.spin(0), tolerance, where());
}

TEST(ImpactLaw, V07_thin_rod) {
  // Inertia of a thin rod: m L2 / 12.
  const double mass = 9000.0, length = 20.0, speed = 0.5, lever = 0.5 * length;
  const CollisionMass thin{1.0 / mass, 12.0 / (mass * length * length)};
  const double impulse = impact_frictionless(inverse_effective_mass(thin, {lever, 0.0}, {0.0, 1.0}), -speed, 0.0);
  const double velocity = speed - impulse * thin.inverse_mass, spin = lever * impulse * thin.inverse_inertia;
  check("V07.thin.J", impulse, rounding);
  check("V07.thin.v", velocity, rounding);
  check("V07.thin.omega", spin, rounding);
  check("V07.thin.dE", -impulse_work(impulse, -speed, 0.0), rounding);
}

TEST_P(Impacts, V07_rod_meets_a_peg) {
  SceneDef scene = quiet_scene();
  // 4 touch inside the end of the rod, so that the contact is on the rod's face, not on the peg's side. J changes by
  // 6e-13.
  const double x = 10.0 - 4.0 * touch;
  scene.fixed = {{{{x, 0.0}, {x - 1.0, -2.0}, {x + 1.0, -2.0}}}};
  scene.floe = {on_floor(rod({}, {0.0, -0.5}))};
  const Impact impact = one_impact(scene, setting());
  check("V07.Iz_rect", impact.before.inertia[2], rounding, where());
  check("V07.rect.J", impact.impulse(0).y, rounding, where());
  check("V07.rect.v", -impact.velocity(0).y, rounding, where());
  check("V07.rect.omega", impact.spin(0), rounding, where());
  check("V07.rect.dE", impact.energy_lost(), rounding, where());
}

TEST_P(Impacts, V08_spinning_corner) {
  const Impact impact = one_impact(over_floor(square({}, {}, degrees(30.0), 0.02)), setting());
  const double eta = value_of("V06.eta");
  check("V08.un", 0.02 * eta, rounding, where());
  check("V08.J", impact.impulse(0).y, rounding, where());
  check("V08.vy", impact.velocity(0).y, rounding, where());
  check("V08.omega", impact.spin(0), rounding, where());
}

TEST_P(Impacts, V09_corner_on_a_face) {
  SceneDef scene = quiet_scene();
  FloeDef b{rectangle(8.0, 4.0), {}, degrees(20.0), {-0.6, 0.35}, 0.03, 0.5};
  const double c = std::cos(degrees(20.0)), s = std::sin(degrees(20.0));
  const Vec2 arm_b{-4.0 * c - 2.0 * s, -4.0 * s + 2.0 * c};
  b.position_m = Vec2{5.0 - touch, 2.0} - arm_b;
  scene.floe = {square({}, {0.1, 0.0}, 0.0, -0.01), b};
  check("V09.xB", b.position_m.x, rounding, where());
  check("V09.yB", b.position_m.y, rounding, where());
  const Impact impact = one_impact(scene, setting());
  check("V09.Pn", impact.impulse(1).x, rounding, where());
  check_value("V09.Pt", 0.0, impact.impulse(1).y, rounding * value_of("V09.Pn"), "N s", where());
  check("V09.Avx", impact.velocity(0).x, rounding, where());
  check_value("V09.Avy", 0.0, impact.velocity(0).y, rounding, "m/s", where());
  check("V09.Aw", impact.spin(0), rounding, where());
  check("V09.Bvx", impact.velocity(1).x, rounding, where());
  check("V09.Bvy", impact.velocity(1).y, rounding, where());
  check("V09.Bw", impact.spin(1), rounding, where());
  check("V09.dE", impact.energy_lost(), rounding, where());
  check("V09.KE0", impact.ledger.start.energy, rounding, where());
  check("V09.px", impact.ledger.now.momentum.x, rounding, where());
  check("V09.py", impact.ledger.now.momentum.y, rounding, where());
  check("V09.Lz", angular_momentum(impact.after), rounding, where());
}

TEST(ImpactLaw, V09_compliance_of_two_bodies) {
  const Vec2 arm_a{5.0, 2.0}, arm_b = arm_a - Vec2{value_of("V09.xB"), value_of("V09.yB")};
  const ContactCompliance k =
      contact_compliance({1.0 / 45000.0, 1.0 / 750000.0}, arm_a, {1.0 / 14400.0, 1.0 / 96000.0}, arm_b, {1.0, 0.0});
  const Vec2 u = Vec2{-0.6, 0.35} + cross(0.03, arm_b) - Vec2{0.1, 0.0} - cross(-0.01, arm_a);
  check("V09.un", u.x, rounding);
  check("V09.ut", u.y, rounding);
  check("V09.Knn", k.nn, rounding);
  check("V09.Ktt", k.tt, rounding);
  // The cross term is a small difference of terms of size eta xi / I = 1e-4.
  check_absolute("V09.Knt", k.nt, rounding * 1e-4);
  check("V09.Me", 1.0 / k.nn, rounding);
}

TEST_P(Impacts, V11_notch) {
  const double alpha = degrees(35.0), speed = 0.5;
  SceneDef scene = quiet_scene();
  scene.fixed = {notch_side(alpha, 1.0), notch_side(alpha, -1.0)};
  scene.floe = {square({0.0, 5.0 + 5.0 / std::tan(alpha) - touch}, {0.0, -speed})};
  const Impact impact = one_impact(scene, setting());
  EXPECT_EQ(impact.quality.contacts, 2);
  // By symmetry the two impulses are equal, so the vertical impulse gives both.
  const double each = 0.5 * impact.impulse(0).y / std::sin(alpha);
  if (setting().coupled()) {
    check("V11.J", each, rounding, where());
    check_value("V11.v", 0.0, impact.velocity(0).y, speed * rounding, "m/s", where());
  } else {
    // independent: each wall is met as if it were alone, J = M_e V sin(alpha), and both are added.
    const double eta = 5.0 * std::cos(alpha) + 5.0 * -std::sin(alpha);
    const double alone = speed * std::sin(alpha) / (1.0 / 45000.0 + eta * eta / 750000.0);
    check_value("V11.alone", alone, each, rounding * alone, "N s", where());
  }
}

TEST_P(Impacts, V12_three_in_a_row) {
  SceneDef scene = row_of_squares(3, 0.6);
  const Impact impact = one_impact(scene, setting());
  EXPECT_EQ(impact.quality.contacts, 4);
  if (setting().coupled()) {
    // Iterated until no event asks for more than 1e-14 of the speed.
    for (const std::size_t i : {0u, 1u, 2u}) check("V12.v", impact.velocity(i).x, rounding, where());
    check("V12.J12", -impact.impulse(0).x, rounding, where());
    check("V12.J23", impact.impulse(2).x, rounding, where());
  } else {
    // independent: only the first pair closes at the start of the time step, and it shares its momentum equally.
    check_value("V12.first", 0.3, impact.velocity(0).x, 0.3 * rounding, "m/s", where());
    check_value("V12.second", 0.3, impact.velocity(1).x, 0.3 * rounding, "m/s", where());
    check_value("V12.third", 0.0, impact.velocity(2).x, 0.3 * rounding, "m/s", where());
  }
}

/// A row of n + 1 floes with one contact point per pair, the first at 0.6 m/s, in one time step.
Impact row_impact(int n, double tolerance, const Setting& setting) {
  SceneDef scene = row_of_squares(n + 1, 0.6);
  scene.contact.manifold = Manifold::chord_middle;
  scene.numerics.residual_tolerance = tolerance;
  const Impact impact = one_impact(scene, setting);
  EXPECT_EQ(impact.quality.contacts, n);
  return impact;
}

TEST_P(Iterations, V13_common_velocity_of_a_row) {
  for (const int n : {2, 10, 19, 99}) {
    const Impact impact = row_impact(n, 1e-14, setting());
    double error = 0.0;
    for (int i = 0; i <= n; ++i)
      error = std::max(error, std::fabs(impact.velocity(static_cast<std::size_t>(i)).x - 0.6 / (n + 1)));
    // Every gap asks for less than 1e-14 x 0.6 m/s; the slowest mode of a row responds with up to (n / pi)^2 times
    // that.
    check_value("V13.v_" + std::to_string(n), 0.0, error, 0.6e-14 * n * n, "m/s", where());
  }
}

TEST_P(Iterations, V13_iterations_grow_with_the_length_of_a_row) {
  if (setting().engine == "reference")
    GTEST_SKIP() << "the reference solver factors its equations: its iterations do not grow with the row";
  // Gauss-Seidel iterations grow with the square of the length: 84 times as many for 99 floes as for 10
  // (V13.sweeps_GS).
  const int few = row_impact(10, 1e-6, setting()).quality.iterations;
  const int many = row_impact(99, 1e-6, setting()).quality.iterations;
  EXPECT_GT(few, 10) << "news cannot travel faster than one contact an iteration";
  EXPECT_LT(many, 20 * few);
}

TEST(ImpactLaw, V13_other_methods) {
  for (const char* n : {"2", "10", "19", "99"}) {
    not_offered("V13.rho_J_" + std::string(n));
    not_offered("V13.rho_GS_" + std::string(n));
    not_offered("V13.sweeps_GS_" + std::string(n));
  }
  not_offered("V14.rho_GS");
  not_offered("V14.w_1sweep");
  not_offered("V14.un_1sweep");
}

TEST_P(Impacts, V14_two_corners_of_a_face) {
  const SceneDef scene = over_floor(square({}, {0.0, -0.5}));
  const Impact impact = one_impact(scene, setting());
  EXPECT_EQ(impact.quality.contacts, 2);
  // The remaining spin shows the difference of the two impulses: J1 - J2 = I omega / 5 m.
  const double difference = impact.before.inertia[2] * std::fabs(impact.spin(0)) / 5.0;
  check("V14.J", 0.5 * (impact.impulse(0).y + difference), rounding, where());
  check("V14.J", 0.5 * (impact.impulse(0).y - difference), rounding, where());
}

/// V15: the time at which the n-th floe at rest is hit, and the speed of all floes some time later.
void fall_in_line(int n, const Setting& setting) {
  const double dt = 0.02, gap = 4.0, speed = 0.6;
  SceneDef scene = quiet_scene();
  scene.numerics.time_step_s = dt;
  for (int i = 0; i <= n; ++i) scene.floe.push_back(square({(10.0 + gap) * i, 0.0}));
  scene.floe[0].velocity_m_per_s = {speed, 0.0};
  Simulation run = start(scene, setting);
  run.log.wants_events = false;
  const std::size_t last = static_cast<std::size_t>(n) + 1;
  const std::string key = std::to_string(n);
  while (run.bodies().velocity[last].x == 0.0 && run.engine->step() < 100000) run.advance(1);
  const double hit = static_cast<double>(run.engine->step()) * dt;
  // An overlap is seen at the next time step: 2 dt per impact. Independent also needs several time steps to share the
  // momentum in the row; its error falls by cos(pi / (row + 1)) per time step. Meanwhile the front is too fast or slow
  // by a factor of at most V/V_n = row.
  double tolerance = 0.0;
  for (int row = 1; row <= n; ++row) {
    tolerance += 2.0 * dt;
    if (!setting.coupled()) tolerance += row * dt / (1.0 - std::cos(M_PI / (row + 1)));
  }
  check_absolute("V15.t" + key, hit, tolerance, setting.where());
  run.advance(setting.coupled() ? 4 : 2000);
  for (std::size_t i = 1; i <= last; ++i) check("V15.v" + key, run.bodies().velocity[i].x, 1e-10, setting.where());
  expect_closed_books(run);
}

TEST_P(Impacts, V15_five_fall_in_line) { fall_in_line(5, setting()); }
TEST_P(Impacts, V15_ten_fall_in_line) { fall_in_line(10, setting()); }

}  // namespace
}  // namespace gem::verification
