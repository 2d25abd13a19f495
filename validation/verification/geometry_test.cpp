// Areas, moments and overlaps against closed form: V01 to V03, V21, V50 and V51.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gem/base/strict_math.h"
#include "gem/events/events.h"
#include "gem/field/field.h"
#include "gem/geometry/convex_contact.h"
#include "gem/geometry/polygon.h"
#include "gem/scene/check_scene.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

std::vector<Vec2> regular(int sides, double radius) {
  std::vector<Vec2> outline;
  for (int i = 0; i < sides; ++i)
    outline.push_back(rotate(strict::rotation_of_turns(static_cast<double>(i) / sides), {radius, 0.0}));
  return outline;
}

void check_pentagon(std::vector<Vec2> outline, Vec2 shift, bool clockwise) {
  for (Vec2& p : outline) p += shift;
  if (clockwise) std::reverse(outline.begin(), outline.end());
  const PolygonMoments moments = polygon_moments(outline);
  const double sign = clockwise ? -1.0 : 1.0;
  check("V01.area", sign * moments.area, rounding);
  // A centroid at 1400 m is rounded to 2e-13 m: 5e-14 of the value.
  check("V01.cx", moments.centroid.x - shift.x, rounding);
  check("V01.cy", moments.centroid.y - shift.y, rounding);
  check("V01.J", sign * moments.second_moment, rounding);

  SceneDef scene = quiet_scene();
  scene.floe = {{outline, {}, 0.0, {}, 0.0, 0.5}};
  const Bodies bodies = make_field(scene);
  check("V01.mass", bodies.mass[1], rounding);
  check("V01.Iz", bodies.inertia[1], rounding);
}

TEST(Geometry, V01_pentagon) {
  const std::vector<Vec2> pentagon = {{0.0, 0.0}, {8.0, -1.0}, {11.0, 4.0}, {6.0, 9.0}, {-1.0, 5.0}};
  for (const bool clockwise : {false, true})
    for (const Vec2 shift : {Vec2{0.0, 0.0}, Vec2{1400.0, 300.0}}) check_pentagon(pentagon, shift, clockwise);
}

TEST(Geometry, V02_platform_outline) {
  SceneDef scene = quiet_scene();
  scene.platform.present = true;
  const Bodies bodies = make_field(scene);
  const std::vector<Vec2> outline = world_outline(bodies, 0);
  check("V02.area", bodies.area[0], rounding);
  check("V02.apothem", length(0.5 * (outline[0] + outline[1])), rounding);
  check("V02.edge", length(outline[1] - outline[0]), rounding);
  check("V02.k2", bodies.inertia[0] / bodies.mass[0], rounding);
  check("V02.Iz", bodies.inertia[0], rounding);
  // The program's diameter is that of the circle through the corners. The two other readings follow from its polygon.
  const double area_of_circle = std::numbers::pi * 2500.0;
  check("V02.R_equal_area", 50.0 * std::sqrt(area_of_circle / bodies.area[0]), rounding);
  check("V02.R_apothem50", 50.0 * 50.0 / length(0.5 * (outline[0] + outline[1])), rounding);
}

/// Area of the overlap of two convex outlines: `b` cut by every edge of `a`.
double overlap_area(const std::vector<Vec2>& a, std::vector<Vec2> b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 edge = a[(i + 1) % a.size()] - a[i];
    std::vector<Vec2> kept;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec2 p = b[j], q = b[(j + 1) % b.size()];
      const double at_p = cross(edge, p - a[i]), at_q = cross(edge, q - a[i]);
      if (at_p >= 0.0) kept.push_back(p);
      if ((at_p >= 0.0) != (at_q >= 0.0)) kept.push_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
    b = kept;
  }
  return polygon_moments(b).area;
}

TEST(Geometry, V03_overlap_area) {
  // The program needs chords, not areas. Here its area formula is judged on an overlap that the test cuts out.
  std::vector<Vec2> turned_square = rectangle(10.0, 10.0), offset = rectangle(10.0, 10.0);
  for (Vec2& p : turned_square) p = rotate(strict::rotation_of_angle(degrees(45.0)), p);
  for (Vec2& p : offset) p += {7.0, 4.0};
  check("V03.octagon", overlap_area(rectangle(10.0, 10.0), turned_square), rounding);
  check("V03.rect", overlap_area(rectangle(10.0, 10.0), offset), rounding);
}

/// Corners and normals of an outline in the form that the contact functions take.
struct OutlineCopy {
  explicit OutlineCopy(const std::vector<Vec2>& corners) : corner(corners) {
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const Vec2 edge = corner[(i + 1) % corner.size()] - corner[i];
      normal.push_back((1.0 / length(edge)) * turned_right(edge));
    }
  }
  Outline view() const { return {corner.data(), normal.data(), static_cast<int>(corner.size())}; }
  std::vector<Vec2> corner, normal;
};

TEST(Geometry, V03_chord_of_the_overlap) {
  const OutlineCopy square_outline(rectangle(10.0, 10.0));
  const Vec2 offset{7.0, 4.0};
  const Separation axis = find_axes(square_outline.view(), square_outline.view(), offset).first;
  const ContactGeometry contact = chord_contact(square_outline.view(), square_outline.view(), offset, axis);
  // The overlap is the rectangle [2, 5] x [-1, 5]; its chord joins (2, 5) and (5, -1).
  check_value("V03.chord", std::sqrt(45.0), contact.width, 10.0 * rounding, "m");
  check_value("V03.chord.x", 3.5, contact.point[0].position.x, 10.0 * rounding, "m");
  check_value("V03.chord.y", 2.0, contact.point[0].position.y, 10.0 * rounding, "m");
}

/// Smallest friction at which some corner jams when it slides at some angle, from the program's compliance.
double jamming_bound(const std::vector<Vec2>& outline) {
  const PolygonMoments moments = polygon_moments(outline);
  double least = std::numeric_limits<double>::infinity();
  constexpr int steps = 20000;
  for (const Vec2 corner : outline)
    for (int i = 0; i < steps; ++i) {
      const Vec2 arm = rotate(strict::rotation_of_turns(static_cast<double>(i) / steps), corner - moments.centroid);
      const ContactCompliance k =
          contact_compliance({}, {}, {1.0, moments.area / moments.second_moment}, arm, {0.0, 1.0});
      if (k.nt != 0.0) least = std::min(least, k.nn / std::fabs(k.nt));
    }
  return least;
}

TEST(Geometry, V21_jamming_friction) {
  // The minimum over angles is flat: missing it by a step of 2 pi / 20000 costs (1.6e-4)^2 times the curvature (about
  // 5).
  const double scan = 5e-7;
  check("V21.rectangle", jamming_bound(rectangle(20.0, 1.0)), scan);
  check("V21.rectangle", jamming_bound(rectangle(10.0, 10.0)), scan);
  check("V21.triangle", jamming_bound(regular(3, 1.0)), scan);
  check("V21.hexagon", jamming_bound(regular(6, 1.0)), scan);
  check("V21.gon20", jamming_bound(regular(20, 1.0)), scan);
  // k2 / R2 of an n-gon is (2 pi / n)^2 / 12 below the disc's 1/2. The bound follows with slope 2.3: 2.7e-4 for n =
  // 128.
  check("V21.disc", jamming_bound(regular(128, 1.0)), 3e-4);
}

TEST(Geometry, V21_warning_above_every_bound) {
  SceneDef scene = quiet_scene();
  scene.ice.friction_ice = 1.09;
  const std::size_t without = scene_warnings(scene).size();
  scene.ice.friction_ice = value_of("V21.triangle");
  check_value("V21.warnings", 1.0, static_cast<double>(scene_warnings(scene).size() - without), 0.0, "-");
}

class Kinematics : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Kinematics, ::testing::ValuesIn(all_settings()), setting_name);

TEST_P(Kinematics, V50_rod_turns_into_a_wall) {
  const double dt = 1e-3, spin = 0.02;
  SceneDef scene = quiet_scene();
  scene.numerics.time_step_s = dt;
  scene.fixed = {floor_wall()};
  scene.floe = {rod({0.0, 6.0}, {}, 0.0, spin)};
  Simulation run = start(scene, setting());
  run.log.wants_events = false;
  const std::size_t floe = 2;
  while (run.bodies().spin[floe] == spin && run.engine->step() < 100000) run.advance(1);
  const double hit = static_cast<double>(run.engine->step()) * dt;
  const double turned = std::atan2(run.bodies().rotation[floe].sine, run.bodies().rotation[floe].cosine);
  run.advance(2);  // coupled closes the gap exactly in the first step, then stops
  // An overlap is seen up to one time step late, and the end of the time step is recorded: 2 dt.
  check_absolute("V50.t", hit, 2.0 * dt, where());
  check_absolute("V50.theta", turned, 2.0 * dt * spin, where());
  // The lever arm grows by spin x 6 m = 0.12 m/s, and after the event the outline turns on with it: 4 dt in all.
  const double late = 4.0 * dt;
  const Vec2 lever = lowest_corner(rod({}, {}, turned));
  check_absolute("V50.eta", std::fabs(lever.x), late * spin * 6.0, where());
  // omega' = omega / R and v' = omega eta / R follow with d/d eta = -2 eta / (k2 R2) and (1 / R)(1 - 2 eta2 / (k2 R))
  const double eta = value_of("V50.eta"), k2 = 33.416666666666664, factor = 1.0 + eta * eta / k2;
  const double slope_spin = spin * 2.0 * eta / (k2 * factor * factor);
  const double slope_speed = spin / factor * std::fabs(1.0 - 2.0 * eta * eta / (k2 * factor));
  check_absolute("V50.omega", run.bodies().spin[floe], late * 0.12 * slope_spin, where());
  check_absolute("V50.v", run.bodies().velocity[floe].y, late * 0.12 * slope_speed, where());
  expect_closed_books(run, 1e-12);
}

/// Two floes 2 m wide, `elapsed` seconds after first contact at a closing speed of 1 m/s.
Separation after_closing(double elapsed) {
  const OutlineCopy small(rectangle(2.0, 8.0));
  return find_axes(small.view(), small.view(), {2.0 - elapsed, 0.0}).first;
}

/// The time in (low, high) at which `late` turns from false to true.
template <class Late>
double boundary(double low, double high, Late&& late) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (late(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

TEST(Geometry, V51_longest_step) {
  const OutlineCopy small(rectangle(2.0, 8.0));
  const auto flipped = [&](double elapsed) {
    const Separation axis = after_closing(elapsed);
    const Outline outline = small.view();
    return (axis.edge_of_b ? -outline.normal[axis.edge] : outline.normal[axis.edge]).x < 0.0;
  };
  // Bisection down to rounding.
  check("V51.dt_tunnel", boundary(1.0, 3.0, flipped), rounding);
  check("V51.dt_miss", boundary(1.0, 5.0, [](double t) { return after_closing(t).distance > 0.0; }), rounding);

  SceneDef scene = quiet_scene();
  FloeDef left{rectangle(2.0, 8.0), {0.0, 0.0}, 0.0, {0.5, 0.0}, 0.0, 0.5}, right = left;
  right.position_m = {4.0, 0.0};
  right.velocity_m_per_s = {-0.5, 0.0};
  scene.floe = {left, right};
  scene.output.platform_interval_s = scene.output.floes_interval_s = scene.output.force_window_s = 10.0;
  const auto refused = [&](double dt) {
    scene.numerics.time_step_s = dt;
    return !check_scene(scene).empty();
  };
  check("V51.dt_20pct", boundary(0.01, 1.0, refused), rounding);
  scene.numerics.contact_reach = 0.0;  // contacts are no longer foreseen
  check("V51.dt_10pct", boundary(0.01, 1.0, refused), rounding);
}

}  // namespace
}  // namespace gem::verification
