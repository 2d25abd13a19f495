// Difficult outlines and positions: overlap at the start (H3), slivers (H4), parallel faces (H5), corner on corner
// (H6), far from the origin (H12), too small domains (H18).
#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/field/check_outline.h"
#include "gem/field/field.h"
#include "validation/hard/hard.h"

namespace gem::hard {
namespace {

class HardShapes : public verification::OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, HardShapes, ::testing::ValuesIn(verification::all_settings()),
                         verification::setting_name);

void check_refused(const std::string& key, bool refused, const Where& where) {
  verification::check_value(key, 1.0, refused ? 1.0 : 0.0, 0.0, "-", where);
}

TEST_P(HardShapes, H3_overlap_at_the_start) {
  check_refused("H3.refused", is_refused("H03_overlap.toml", {}, "overlaps at the start"), where());
  const SceneDef scene = read_hard_case("H03_overlap.toml", setting());
  SceneDef apart = scene;
  apart.floe[1].position_m.x = 20.0;
  for (const int percent : {1, 10, 100}) {
    const std::string id = "H3.p" + std::to_string(percent);
    Bodies bodies = make_field(apart);
    bodies.position[2].x = 10.0 - 0.1 * percent;
    Watched run(scene, bodies, setting());
    double speed = 0.0;
    Bodies before = run.bodies();
    run.advance(4000, 1, [&] {
      speed = std::max(speed, test::farthest_apart(before, run.bodies()) / scene.numerics.time_step_s);
      before = run.bodies();
    });
    bound(id + ".speed", speed, 0.1, "m/s", where());
    // 10 m at 0.1 m/s take 50 s. After 200 s less than the slack of a contact is left.
    bound(id + ".left", overlaps(run.bodies()).deepest, 1e-3, "m", where());
    expect_sound(id, run);
  }
}

TEST_P(HardShapes, H4_slivers) {
  const SceneDef scene = read_hard_case("H04_slivers.toml", setting());
  Watched run(scene, setting());
  run.advance(4000, 20);
  // A tenth of the sliver's width of 2 cm.
  bound("H4.overlap", run.worst().overlap, 2e-3, "m", where());
  bound("H4.fastest", fastest_floe(run.bodies()), 0.25, "m/s", where());
  EXPECT_GE(run.contacts_now(), 4) << "the stacks do not rest";
  expect_sound("H4", run);
}

TEST(HardOutlines, H4_refused) {
  const auto refused = [](const std::vector<Vec2>& outline, const std::string& what) {
    try {
      check_outline(outline, "floe 0");
    } catch (const Error& error) {
      return std::string(error.what()).find(what) != std::string::npos;
    }
    return false;
  };
  check_refused("H4.short_edge.refused",
                refused({{0.0, 0.0}, {10.0, 0.0}, {10.0, 9.9995}, {9.9996, 10.0}, {0.0, 10.0}}, "shortest allowed"),
                {});
  check_refused("H4.straight_corner.refused",
                refused({{0.0, 0.0}, {5.0, -1e-9}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}}, "must turn"), {});
}

TEST_P(HardShapes, H5_parallel_faces) {
  const SceneDef scene = read_hard_case("H05_parallel_faces.toml", setting());
  for (const double angle : {0.0, 1e-15, -1e-15, 1e-9, -1e-9, 1e-6, -1e-6}) {
    SceneDef turned_scene = scene;
    FloeDef& floe = turned_scene.floe[0];
    floe.angle_rad = angle;
    floe = verification::on_floor(floe);
    Watched run(turned_scene, setting());
    run.advance(20);  // the face settles
    std::size_t points = points_of(run);
    int flips = 0;
    EXPECT_GT(points, 0u);
    run.advance(180, 1, [&] {
      const std::size_t now = points_of(run);
      if (now != points) ++flips;
      points = now;
    });
    char id[32];
    std::snprintf(id, sizeof id, "H5.a%g", angle);
    bound(std::string(id) + ".flips", flips, 0.0, "steps", where());
    expect_sound(id, run);
  }
}

TEST_P(HardShapes, H6_vertex_on_vertex) {
  const SceneDef scene = read_hard_case("H06_vertex_on_vertex.toml", setting());
  Watched run(scene, setting());
  double unequal = 0.0, turning = 0.0, spin = 0.0;
  run.advance(200, 1, [&] {
    const Bodies& b = run.bodies();
    unequal = std::max(unequal, length(b.velocity[1] + b.velocity[2]));
    turning = std::max(turning, std::fabs(b.spin[1] - b.spin[2]));
    spin = std::max({spin, std::fabs(b.spin[1]), std::fabs(b.spin[2])});
  });
  // Equal bodies meet at their common centre: the motion of one is that of the other turned by 180 degrees.
  bound("H6.unequal", unequal, 1e-12, "m/s", where());
  // The contact point lies within the path of one time step, so the lever arms of 7 m differ by no more than that.
  const double path = 0.6 * scene.numerics.time_step_s;
  bound("H6.turning", turning, 1e-12 + spin * path / 7.0, "rad/s", where());
  bound("H6.overlap", run.worst().overlap, path, "m", where());
  expect_sound("H6", run);
}

/// The scene with everything shifted by `shift` along x.
Watched pressed_far(const SceneDef& scene, double shift, const Setting& setting) {
  SceneDef moved = scene;
  for (FloeDef& floe : moved.floe) floe.position_m.x += shift;
  for (FixedDef& fixed : moved.fixed)
    for (Vec2& p : fixed.outline_m) p.x += shift;
  moved.output.retire_x_m = 1e12;
  // At the tolerance of the case, rounding decides whether a time step makes one iteration more.
  moved.numerics.residual_tolerance = 1e-10;
  moved.numerics.iterations_maximum = 2000;
  Watched run(moved, setting);
  run.advance(400, 20);
  expect_sound("H12.at" + std::to_string(static_cast<int>(shift) + 1000000), run);
  return run;
}

TEST_P(HardShapes, H12_far_from_origin) {
  const std::string file = "H12_far_from_origin.toml";
  const SceneDef scene = read_hard_case(file, setting());
  const double here = 1e6 - 100.0;  // position of the case
  Watched origin = pressed_far(scene, -1e6, setting());
  for (const double distance : {1e3, 1e6}) {
    Watched far = pressed_far(scene, distance - 1e6, setting());
    double apart = 0.0;
    for (std::size_t i = 2; i < far.bodies().count(); ++i)
      apart = std::max(apart, length(far.bodies().position[i] - origin.bodies().position[i] - Vec2{distance, 0.0}));
    // 400 time steps, each rounding a position to half the spacing of doubles there.
    const double spacing = distance * 0x1p-52;
    bound("H12.moved_1e" + std::to_string(static_cast<int>(std::log10(distance))), apart, 400.0 * spacing, "m",
          where());
  }
  EXPECT_EQ(scene.floe[0].position_m.x, here);
  const bool refused = is_refused(file, {"floe=[{outline_m=[[0,0],[9,0],[0,9]],position_m=[1e9,0.0]}]"}, "position_m");
  check_refused("H12.1e9.refused", refused, where());
}

TEST_P(HardShapes, H18_over_confined) {
  const std::string file = "H18_over_confined.toml";
  check_refused("H18.refused", is_refused(file, {}, "overlap at the start"), where());
  const SceneDef scene = read_hard_case(file, setting());
  SceneDef loose = scene;
  for (FloeDef& floe : loose.floe) floe.position_m = 2.0 * floe.position_m;
  for (FixedDef& fixed : loose.fixed)
    for (Vec2& p : fixed.outline_m) p = 2.0 * p;
  Bodies bodies = make_field(loose);
  // The case unchanged: floes at their positions, walls of half the size.
  for (std::size_t i = first_floe_of(bodies); i < bodies.count(); ++i) bodies.position[i] = 0.5 * bodies.position[i];
  for (std::size_t i = 1; i < first_floe_of(bodies); ++i) {
    bodies.position[i] = 0.5 * bodies.position[i];
    bodies.radius[i] *= 0.5;
    for (int v = bodies.vertex_begin[i]; v < bodies.vertex_begin[i + 1]; ++v) bodies.vertex[v] = 0.5 * bodies.vertex[v];
  }
  Watched run(scene, bodies, setting());
  run.advance(400);
  double fastest = 0.0, longest = 0.0;
  Bodies before = run.bodies();
  run.advance(800, 1, [&] {
    fastest = std::max(fastest, fastest_floe(run.bodies()));
    longest = std::max(longest, test::farthest_apart(before, run.bodies()) / scene.numerics.time_step_s);
    before = run.bodies();
  });
  bound("H18.fastest", fastest, 2e-3, "m/s", where());
  bound("H18.moving", longest, 2e-3, "m/s", where());
  // At the end of the minute nothing moves any more: positions stay the same except for rounding.
  before = run.bodies();
  run.advance(100);
  bound("H18.end_moving", test::farthest_apart(before, run.bodies()) / 5.0, 1e-9, "m/s", where());
  double farthest = 0.0;
  for (std::size_t i = first_floe_of(bodies); i < bodies.count(); ++i)
    farthest = std::max({farthest, std::fabs(run.bodies().position[i].x), std::fabs(run.bodies().position[i].y)});
  bound("H18.escape", farthest, 14.7, "m", where());
  expect_sound("H18", run);
}

}  // namespace
}  // namespace gem::hard
