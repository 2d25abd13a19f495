// Impact with Coulomb friction against closed form: V16 to V20.
#include <cmath>

#include "gem/events/events.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Friction : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Friction, ::testing::ValuesIn(all_settings()), setting_name);

/// Velocity of the lowest corner along x after the impact.
double slip_left(const Impact& impact, const FloeDef& floe) {
  return (impact.velocity(0) + cross(impact.spin(0), lowest_corner(floe))).x;
}

/// Impulse ratio that sticking needs, i.e. the smallest friction that sticks.
double sticking_ratio(const ContactCompliance& k, double u_n, double u_t) {
  const ContactImpulse impulse = impact_one_step(k, u_n, u_t, 0.0, 100.0);
  return std::fabs(impulse.tangential) / impulse.normal;
}

/// Compliance of a floe of mass m and inertia I on the floor; the tangent is -x.
ContactCompliance on_floor_compliance(const FloeDef& floe, double mass, double inertia) {
  return contact_compliance({}, {}, {1.0 / mass, 1.0 / inertia}, lowest_corner(floe), {0.0, 1.0});
}

TEST(FrictionLaw, thresholds_of_sticking) {
  const ContactCompliance v16 = on_floor_compliance(square({}, {}, degrees(45.0)), 45000.0, 750000.0);
  check("V16.mu_stick", sticking_ratio(v16, -0.5, -0.6), rounding);
  const ContactCompliance v17 = on_floor_compliance(square({}, {}, degrees(30.0)), 45000.0, 750000.0);
  check("V17.mu_stick", sticking_ratio(v17, -0.5, 0.4), rounding);
  const ContactCompliance v18{value_of("V09.Knn"), value_of("V09.Ktt"), value_of("V09.Knt")};
  check("V18.mu_stick", sticking_ratio(v18, value_of("V09.un"), value_of("V09.ut")), rounding);
}

TEST_P(Friction, V16_contact_below_the_centre) {
  const FloeDef floe = square({}, {0.6, -0.5}, degrees(45.0));
  const auto run = [&](const std::string& key, double friction) {
    const Impact impact = one_impact(over_floor(floe, friction), setting());
    check(key + ".Pt", impact.impulse(0).x, rounding, where());
    check(key + ".vx", impact.velocity(0).x, rounding, where());
    check(key + ".omega", impact.spin(0), rounding, where());
    check(key + ".dE", impact.energy_lost(), rounding, where());
    return slip_left(impact, floe);
  };
  check("V16.slip.ut", run("V16.slip", 0.1), rounding, where());
  check_value("V16.stick.ut", 0.0, run("V16.stick", 0.4), 0.6 * rounding, "m/s", where());
}

TEST_P(Friction, V17_leaning_corner) {
  const FloeDef floe = square({}, {-0.4, -0.5}, degrees(30.0));
  const auto run = [&](const std::string& key, double friction) {
    const Impact impact = one_impact(over_floor(floe, friction), setting());
    check(key + ".Pt", impact.impulse(0).x, rounding, where());
    check(key + ".Pn", impact.impulse(0).y, rounding, where());
    check(key + ".vx", impact.velocity(0).x, rounding, where());
    // A difference of two speeds of 0.5 m/s.
    check_absolute(key + ".vy", impact.velocity(0).y, 0.5 * rounding, where());
    check(key + ".omega", impact.spin(0), rounding, where());
    check_absolute(key + ".ut", slip_left(impact, floe), 0.5 * rounding, where());
    check(key + ".dE", impact.energy_lost(), rounding, where());
  };
  run("V17.slip", 0.1);
  run("V17.stick", 0.6);
}

TEST_P(Friction, V18_corner_on_a_face) {
  const auto run = [&](const std::string& key, double friction) {
    const Impact impact = one_impact(corner_on_face(friction), setting());
    check(key + ".Pn", impact.impulse(1).x, rounding, where());
    check(key + ".Pt", impact.impulse(1).y, rounding, where());
    check(key + ".Avx", impact.velocity(0).x, rounding, where());
    check(key + ".Avy", impact.velocity(0).y, rounding, where());
    check(key + ".Aw", impact.spin(0), rounding, where());
    check(key + ".Bvx", impact.velocity(1).x, rounding, where());
    check(key + ".Bvy", impact.velocity(1).y, rounding, where());
    check(key + ".Bw", impact.spin(1), rounding, where());
    check(key + ".dE", impact.energy_lost(), rounding, where());
    check("V09.Lz", angular_momentum(impact.after), rounding, where());
  };
  run("V18.mu005", 0.05);
  run("V18.mu030", 0.3);
}

TEST_P(Friction, V19_which_friction_law) {
  const FloeDef floe = rod({}, {0.05, -0.5}, degrees(45.0));
  check("V19.rx", lowest_corner(floe).x, rounding, where());
  check("V19.ry", lowest_corner(floe).y, rounding, where());
  const auto run = [&](const std::string& key, FrictionLaw law) {
    SceneDef scene = over_floor(floe, 0.2);
    scene.contact.friction_law = law;
    const Impact impact = one_impact(scene, setting());
    check(key + ".Pn", impact.impulse(0).y, rounding, where());
    check(key + ".Pt", impact.impulse(0).x, rounding, where());
    check(key + ".ut", slip_left(impact, floe), rounding, where());
    check(key + ".vy", impact.velocity(0).y, rounding, where());
    check(key + ".omega", impact.spin(0), rounding, where());
    check(key + ".dE", impact.energy_lost(), rounding, where());
  };
  run("V19.moreau", FrictionLaw::one_step);
  run("V19.fixed", FrictionLaw::fixed_direction);
}

TEST(FrictionLaw, V19_laws) {
  const FloeDef floe = rod({}, {0.05, -0.5}, degrees(45.0));
  const ContactCompliance k = on_floor_compliance(floe, 9000.0, 300750.0);
  check("V19.ratio", std::fabs(k.nt) / k.tt, rounding);
  const ContactImpulse fixed = impact_fixed_direction(k, -0.5, -0.05, 0.0, 0.2);
  check("V19.fixed.Pn", fixed.normal, rounding);
  check("V19.fixed.Pt", -fixed.tangential, rounding);
  const ContactImpulse one_step = impact_one_step(k, -0.5, -0.05, 0.0, 0.2);
  check("V19.moreau.Pn", one_step.normal, rounding);
  check("V19.moreau.Pt", -one_step.tangential, rounding);
  for (const char* what : {"Pn", "Pt", "ut", "vy", "omega", "dE"}) not_offered("V19.routh." + std::string(what));
}

/// The floe has pivoted about its corner A and lands with corner B.
FloeDef landing() { return square({}, {0.2, -0.2}, 0.0, -0.04); }

TEST_P(Friction, V20_rocking_sticks) {
  const Impact impact = one_impact(over_floor(landing(), 0.7), setting());
  // Two points of one face are iterated: each sweep reduces the error at least tenfold, over 24 sweeps or to 1e-14 of
  // the speed.
  check("V20.stick.omega", impact.spin(0), rounding, where());
  check("V20.stick.vx", impact.velocity(0).x, rounding, where());
  check("V20.stick.vy", impact.velocity(0).y, rounding, where());
  check("V20.stick.PBt", impact.impulse(0).x, rounding, where());
  check("V20.stick.PBn", impact.impulse(0).y, rounding, where());
  check("V20.stick.mu_needed", -impact.impulse(0).x / impact.impulse(0).y, rounding, where());
  check("V20.stick.dE", impact.energy_lost(), rounding, where());
  const double rise_of_a = impact.velocity(0).y + impact.spin(0) * -5.0;
  EXPECT_GT(rise_of_a, 0.0) << "corner A stays on the wall";
}

TEST_P(Friction, V20_rocking_slides) {
  const Impact impact = one_impact(over_floor(landing(), 0.0), setting());
  // Twist 5 m x (P_B - P_A) and sum P_B + P_A, from the changes of spin and speed.
  const double sum = impact.impulse(0).y, twist = impact.before.inertia[2] * (impact.spin(0) + 0.04);
  check("V20.free.PA", 0.5 * (sum - twist / 5.0), 10.0 * rounding, where());
  check("V20.free.PB", 0.5 * (sum + twist / 5.0), 10.0 * rounding, where());
  check("V20.free.vx", impact.velocity(0).x, rounding, where());
  check("V20.free.dE", impact.energy_lost(), rounding, where());
  check_value("V20.free.vy", 0.0, impact.velocity(0).y, 0.2 * rounding, "m/s", where());
  check_value("V20.free.omega", 0.0, impact.spin(0), 0.04 * rounding, "rad/s", where());
}

}  // namespace
}  // namespace gem::verification
