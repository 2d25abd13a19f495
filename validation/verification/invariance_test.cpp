// Changes that must not affect a run: units, position, direction, order, other bodies, interruptions and logging (M1 to
// M12).
#include <algorithm>
#include <cmath>

#include "gem/base/strict_math.h"
#include "gem/events/events.h"
#include "gem/field/field.h"
#include "validation/verification/crowd.h"

namespace gem::verification {
namespace {

class Invariance : public OnEngines {
 protected:
  /// Runs a scene from its own field for 75 s, until its floes press against each other.
  Simulation run_of(const SceneDef& scene, std::int64_t steps = 1500) {
    Simulation run = start(scene, setting());
    advance_in_contact(run, steps);
    return run;
  }
  void expect_same(const std::string& key, double different) {
    check_value(key, 0.0, different, 0.0, "bodies", where());
  }
};
INSTANTIATE_TEST_SUITE_P(Engines, Invariance, ::testing::ValuesIn(all_settings()), setting_name);

TEST_P(Invariance, M1_masses_by_a_power_of_two) {
  const double factor = 8.0;
  const SceneDef scene = crowd(setting());
  SceneDef heavy = scene;
  heavy.ice.density_kg_per_m3 *= factor;
  heavy.water.density_kg_per_m3 *= factor;
  heavy.platform.mass_kg *= factor;
  heavy.mooring.stiffness_N_per_m *= factor;
  heavy.ice.crushing_pressure_Pa *= factor;
  heavy.contact.elastic_stiffness_N_per_m *= factor;
  Simulation a = run_of(scene), b = run_of(heavy);
  expect_same("M1.bodies", different_bits(a.bodies(), b.bodies()));
  double force = 0.0, given = 0.0;
  for (std::size_t i = 0; i < a.log.platform.size(); ++i) {
    force = std::max(force, length(factor * a.log.platform[i].ice_impulse - b.log.platform[i].ice_impulse));
    given = std::max(given, length(a.log.platform[i].ice_impulse));
  }
  EXPECT_GT(given, 0.0) << "the platform was never touched";
  check_value("M1.impulses", 0.0, force, 0.0, "N s", where());
}

/// Lengths by 4, times by 2: speeds by 2, accelerations unchanged. Thickness is a length too, so masses grow by 64.
SceneDef enlarged(SceneDef s) {
  const double length_factor = 4.0, time_factor = 2.0, speed_factor = 2.0;
  const double stiffness_factor = 64.0 / (time_factor * time_factor);
  const auto lengthen = [&](Vec2& v) { v = length_factor * v; };
  s.numerics.time_step_s *= time_factor;
  s.numerics.list_margin_m *= length_factor;
  s.current.velocity_m_per_s = speed_factor * s.current.velocity_m_per_s;
  s.platform.diameter_m *= length_factor;
  s.platform.mass_kg *= 64.0;
  s.platform_drag.draft_m *= length_factor;
  s.mooring.stiffness_N_per_m *= stiffness_factor;
  s.contact.elastic_stiffness_N_per_m *= stiffness_factor;
  s.output.retire_x_m *= length_factor;
  s.output.event_speed_m_per_s *= speed_factor;
  s.numerics.repair_speed_m_per_s *= speed_factor;
  for (FixedDef& fixed : s.fixed) std::for_each(fixed.outline_m.begin(), fixed.outline_m.end(), lengthen);
  for (FloeDef& floe : s.floe) {
    std::for_each(floe.outline_m.begin(), floe.outline_m.end(), lengthen);
    lengthen(floe.position_m);
    floe.thickness_m *= length_factor;
    floe.velocity_m_per_s = speed_factor * floe.velocity_m_per_s;
    floe.spin_rad_per_s /= time_factor;
  }
  return s;
}

TEST_P(Invariance, M2_lengths_by_four_and_times_by_two) {
  SceneDef scene = crowd(setting());
  // P0 A^ex has a unit of its own and needs a power. It is set out of reach, so that it never caps the elastic stress.
  scene.ice.crushing_pressure_Pa = 1e12;
  Simulation a = run_of(scene), b = run_of(enlarged(scene));
  Bodies small = b.bodies();
  for (std::size_t i = 0; i < small.count(); ++i) {
    small.position[i] = 0.25 * small.position[i];
    small.velocity[i] = 0.5 * small.velocity[i];
    small.spin[i] *= 2.0;
  }
  expect_same("M2.bodies", different_bits(a.bodies(), small));
}

/// Advances a pressed crowd and its image side by side.
template <class Change>
double apart_after(std::int64_t steps, const SceneDef& scene, const SceneDef& image, const Setting& setting,
                   Change&& change, double* bits = nullptr) {
  const Bodies bodies = pressed(crowd(setting), setting);
  Simulation a = start_on(scene, bodies, setting), b = start_on(image, change(bodies), setting);
  EXPECT_EQ(advance_in_contact(a, steps), advance_in_contact(b, steps));
  const Bodies expected_image = change(a.bodies());
  if (bits != nullptr) *bits = different_bits(expected_image, b.bodies());
  return farthest_apart(expected_image, b.bodies());
}

Bodies mirrored(Bodies b) {
  for (std::size_t i = 0; i < b.count(); ++i) {
    b.position[i].y = -b.position[i].y;
    b.velocity[i].y = -b.velocity[i].y;
    b.rotation[i].sine = -b.rotation[i].sine;
    b.spin[i] = -b.spin[i];
    std::reverse(b.vertex.begin() + b.vertex_begin[i], b.vertex.begin() + b.vertex_begin[i + 1]);
  }
  for (Vec2& v : b.vertex) v.y = -v.y;
  return b;
}

/// A crowd whose velocities do not depend on rounding in the iterations. Friction in a crowd has many answers, and
/// iterations that stop early have more; without both the velocities are unique.
SceneDef with_one_answer(SceneDef scene, const Setting& setting) {
  if (!setting.coupled()) return scene;
  scene.ice.friction_ice = scene.ice.friction_structure = 0.0;
  return settled(scene);
}

TEST_P(Invariance, M3_mirror) {
  const SceneDef scene = with_one_answer(crowd(setting()), setting());
  SceneDef image = scene;
  image.current.velocity_m_per_s.y *= -1.0;
  // In a mirror the outline stays counter-clockwise, so its edges start at their other corners. Crossings and depths
  // are rounded differently (7e-15 m at 64 m), and the two points of a face are visited in another order. So the result
  // is not equal to the bit.
  check_value("M3.corners", 0.0, apart_after(5, scene, image, setting(), mirrored), 1e-11, "m", where());
}

Bodies turned_by(Bodies b, Rotation q) {
  const auto turn = [&](const Rotation& r) {
    return Rotation{q.cosine * r.cosine - q.sine * r.sine, q.sine * r.cosine + q.cosine * r.sine};
  };
  for (std::size_t i = 0; i < b.count(); ++i) {
    b.position[i] = rotate(q, b.position[i]);
    b.velocity[i] = rotate(q, b.velocity[i]);
    b.rotation[i] = turn(b.rotation[i]);
  }
  return b;
}

TEST_P(Invariance, M4_quarter_turn) {
  // The order of elimination takes x before y, so splitting has other rounding after a turn.
  const bool exact = setting().engine == "reference" || !setting().coupled() || setting().gradient();
  const SceneDef scene = exact ? crowd(setting()) : with_one_answer(crowd(setting()), setting());
  const Rotation quarter{0.0, 1.0};
  SceneDef image = scene;
  image.current.velocity_m_per_s = rotate(quarter, scene.current.velocity_m_per_s);
  double bits = -1.0;
  const double apart = apart_after(
      exact ? 300 : 5, scene, image, setting(), [&](const Bodies& b) { return turned_by(b, quarter); }, &bits);
  if (exact)
    expect_same("M4.quarter_turn", bits);
  else
    check_value("M4.quarter_turn_apart", 0.0, apart, 1e-9, "m", where());
}

TEST_P(Invariance, M4_turn_by_37_degrees) {
  const SceneDef scene = with_one_answer(crowd(setting()), setting());
  const Rotation turn = strict::rotation_of_angle(degrees(37.0));
  SceneDef image = scene;
  image.current.velocity_m_per_s = rotate(turn, scene.current.velocity_m_per_s);
  const double apart = apart_after(5, scene, image, setting(), [&](const Bodies& b) { return turned_by(b, turn); });
  // Positions are rounded to 7e-15 m. A chord of 1 mm turns its normal by 1e-11, and a few time steps amplify that.
  check_value("M4.turn_37", 0.0, apart, 1e-9, "m", where());
}

TEST_P(Invariance, M5_moving_frame) {
  const SceneDef scene = with_one_answer(crowd(setting(), Surroundings::open_water), setting());
  const Vec2 frame{0.125, -0.25};
  const std::int64_t steps = 5;
  SceneDef moving = scene;
  moving.current.velocity_m_per_s += frame;
  // The reach of coupled contacts depends on the largest speed, which the frame changes; here both have the same reach.
  moving.numerics.contact_reach *= length(scene.current.velocity_m_per_s) / length(moving.current.velocity_m_per_s);
  const Bodies bodies = pressed(crowd(setting(), Surroundings::open_water), setting());
  Bodies shifted = bodies;
  for (std::size_t i = 1; i < shifted.count(); ++i) shifted.velocity[i] += frame;
  Simulation a = start_on(scene, bodies, setting()), b = start_on(moving, shifted, setting());
  advance_in_contact(a, steps);
  advance_in_contact(b, steps);
  Bodies back = b.bodies();
  for (std::size_t i = 1; i < back.count(); ++i) {
    back.velocity[i] -= frame;
    back.position[i] -= static_cast<double>(steps) * scene.numerics.time_step_s * frame;
  }
  // Speeds of 0.3 m/s are rounded differently, by 5e-17. Chords of 1 mm turn their normals by 1e-11.
  check_value("M5.corners", 0.0, farthest_apart(a.bodies(), back), 1e-10, "m", where());
}

TEST_P(Invariance, M6_translation) {
  const SceneDef scene = with_one_answer(crowd(setting()), setting());
  const Vec2 shift{1024.0, 1024.0};
  SceneDef image = scene;
  image.platform.anchor_m += shift;
  const Bodies bodies = pressed(scene, setting());
  Bodies moved = bodies;
  for (Vec2& p : moved.position) p += shift;
  Simulation a = start_on(scene, bodies, setting()), b = start_on(image, moved, setting());
  advance_in_contact(a, 5);
  advance_in_contact(b, 5);
  Bodies back = b.bodies();
  for (Vec2& p : back.position) p -= shift;
  // Positions beyond 1024 m are rounded to 2.3e-13 m, 32 times more than here. Each of 5 time steps may amplify that
  // tenfold.
  check_value("M6.corners", 0.0, farthest_apart(a.bodies(), back), 1e-11, "m", where());
}

/// The bodies with the floes in reverse order.
Bodies reversed(const Bodies& b) {
  Bodies r;
  std::size_t first = 0;
  while (first < b.count() && b.kind[first] != BodyKind::floe) ++first;
  for (std::size_t i = 0; i < b.count(); ++i) {
    const std::size_t from = i < first ? i : b.count() - 1 - (i - first);
    BodyDef def;
    def.kind = b.kind[from];
    def.outline.assign(b.vertex.begin() + b.vertex_begin[from], b.vertex.begin() + b.vertex_begin[from + 1]);
    def.thickness = b.thickness[from];
    append(r, def);
    r.radius[i] = b.radius[from];
    r.area[i] = b.area[from];
    r.mass[i] = b.mass[from];
    r.inertia[i] = b.inertia[from];
    r.inverse_mass[i] = b.inverse_mass[from];
    r.inverse_inertia[i] = b.inverse_inertia[from];
    r.drag[i] = b.drag[from];
    r.spin_drag[i] = b.spin_drag[from];
    r.position[i] = b.position[from];
    r.rotation[i] = b.rotation[from];
    r.velocity[i] = b.velocity[from];
    r.spin[i] = b.spin[from];
    r.active[i] = b.active[from];
    std::copy(def.outline.begin(), def.outline.end(), r.vertex.begin() + r.vertex_begin[i]);
  }
  return r;
}

TEST_P(Invariance, M7_order_of_the_floes) {
  SceneDef scene = settled(crowd(setting()));
  // In one time step: 0.05 s x a speed known to 1e-14 (from the sweeps) or 1e-11 (from the normal of a short chord).
  check_value("M7.corners", 0.0, apart_after(1, scene, scene, setting(), reversed), 1e-12, "m", where());
  if (!setting().coupled()) return;
  // The order of the points changes the bits of a sum over the points of a body, not its terms.
  scene.numerics.repair_share = 0.6;
  check_value("M7.repair", 0.0, apart_after(1, scene, scene, setting(), reversed), 1e-12, "m", where());
}

TEST_P(Invariance, M8_far_company) {
  const SceneDef scene = crowd(setting());
  SceneDef company = scene;
  for (int i = 0; i < 1000; ++i) company.floe.push_back(square({-2000.0 - 20.0 * (i % 40), 500.0 + 20.0 * (i / 40)}));
  const Bodies alone = pressed(scene, setting());
  Bodies joined = make_field(company);
  std::copy(alone.position.begin(), alone.position.end(), joined.position.begin());
  std::copy(alone.rotation.begin(), alone.rotation.end(), joined.rotation.begin());
  std::copy(alone.velocity.begin(), alone.velocity.end(), joined.velocity.begin());
  std::copy(alone.spin.begin(), alone.spin.end(), joined.spin.begin());
  const std::int64_t steps = setting().engine == "reference" ? 10 : 300;
  Simulation a = start_on(scene, alone, setting()), b = start_on(company, joined, setting());
  EXPECT_EQ(advance_in_contact(a, steps), advance_in_contact(b, steps));
  expect_same("M8.bodies", different_bits(a.bodies(), b.bodies(), alone.count()));
}

TEST_P(Invariance, M9_split_run) {
  const SceneDef scene = crowd(setting());
  Simulation whole = run_of(scene), first = run_of(scene, 1137), second = start(scene, setting());
  second.engine->restore(first.engine->save());
  advance_in_contact(second, 1500 - 1137);
  expect_same("M9.bodies", different_bits(whole.bodies(), second.bodies()));
  EXPECT_EQ(whole.engine->state_hash(), second.engine->state_hash());
}

TEST_P(Invariance, M10_watching) {
  const SceneDef scene = crowd(setting());
  Simulation watched = run_of(scene), blind = start(scene, setting());
  blind.log.wants_events = false;
  for (int i = 0; i < 1500; i += 7) {
    blind.advance(std::min(7, 1500 - i));
    blind.log.clear();
    blind.engine->ledger();
  }
  EXPECT_GT(watched.log.events.size(), 0u);
  expect_same("M10.bodies", different_bits(watched.bodies(), blind.bodies()));
  EXPECT_EQ(watched.engine->state_hash(), blind.engine->state_hash());
}

TEST_P(Invariance, M11_no_friction) {
  SceneDef scene = crowd(setting());
  // mu = 1e-300 takes the path with friction, but its impulses vanish against every speed.
  scene.ice.friction_ice = scene.ice.friction_structure = 1e-300;
  SceneDef frictionless = scene;
  frictionless.ice.friction_ice = frictionless.ice.friction_structure = 0.0;
  if (setting().engine == "reference" && setting().coupled()) {
    // The equations with friction have more unknowns and other rounding: 1e-13 of the speeds in one time step, as in
    // M7.
    const auto as_it_is = [](const Bodies& b) { return b; };
    const double apart = apart_after(1, settled(scene), settled(frictionless), setting(), as_it_is);
    check_value("M11.corners", 0.0, apart, 1e-12, "m", where());
    return;
  }
  Simulation a = run_of(scene), b = run_of(frictionless);
  expect_same("M11.bodies", different_bits(a.bodies(), b.bodies()));
}

TEST(InvarianceLaw, M11_laws_without_friction) {
  const ContactCompliance k = contact_compliance({1.0 / 45000.0, 1.0 / 750000.0}, {5.0, 2.0},
                                                 {1.0 / 14400.0, 1.0 / 96000.0}, {-4.4, 0.5}, {1.0, 0.0});
  const double alone = impact_frictionless(k.nn, -0.7, 0.0);
  check_value("M11.one_step", alone, impact_one_step(k, -0.7, 0.3, 0.0, 0.0).normal, 0.0, "N s");
  check_value("M11.fixed_direction", alone, impact_fixed_direction(k, -0.7, 0.3, 0.0, 0.0).normal, 0.0, "N s");
}

TEST_P(Invariance, M12_time_reversal) {
  SceneDef scene = crowd(setting());
  scene.water.drag_law = DragLaw::none;
  scene.platform.start_offset_m = {1.0, 0.5};
  // far enough apart that they never touch
  for (FloeDef& floe : scene.floe) floe.position_m = 4.0 * floe.position_m;
  scene.fixed.clear();
  const std::int64_t steps = 400;
  Simulation run = start(scene, setting());
  const Bodies before = run.bodies();
  run.advance(steps);
  EXPECT_GT(farthest_apart(before, run.bodies()), 1.0) << "nothing moved";
  EngineState state = run.engine->save();
  for (Vec2& v : state.bodies.velocity) v = -v;
  for (double& spin : state.bodies.spin) spin = -spin;
  run.engine->restore(state);
  run.advance(steps);
  for (const StepQuality& quality : run.log.quality) ASSERT_EQ(quality.contacts, 0);
  // 1e-12 of positions up to 320 m: 800 sums, each rounded to 2.8e-14 m, stay below it.
  check_value("M12.corners", 0.0, farthest_apart(before, run.bodies()), 1e-12 * 320.0, "m", where());
}

}  // namespace
}  // namespace gem::verification
