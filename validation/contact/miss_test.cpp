// Bodies that pass each other with little room do not meet; a gap that closes is a hit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "gem/base/random.h"
#include "validation/contact/scenes.h"

namespace gem::hits {
namespace {

using Outline2 = std::vector<Vec2>;

/// Distance of a point from a side [m].
double distance_to(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 along = to - from;
  const double share = std::clamp(dot(point - from, along) / dot(along, along), 0.0, 1.0);
  return length(point - from - share * along);
}

/// Distance of two outlines that do not overlap [m].
double distance(const Outline2& a, const Outline2& b) {
  double least = 1e300;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      least = std::min(least, distance_to(a[i], b[j], b[(j + 1) % b.size()]));
      least = std::min(least, distance_to(b[j], a[i], a[(i + 1) % a.size()]));
    }
  return least;
}

bool overlap_along(const Outline2& a, const Outline2& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 normal = turned_right(a[(i + 1) % a.size()] - a[i]);
    double least = 1e300;
    for (const Vec2 corner : b) least = std::min(least, dot(normal, corner - a[i]));
    if (least > 0.0) return false;
  }
  return true;
}

double room(const Outline2& a, const Outline2& b) {
  return overlap_along(a, b) && overlap_along(b, a) ? 0.0 : distance(a, b);
}

/// A body in uniform motion.
struct Mover {
  Outline2 outline;
  Vec2 from, velocity;
  double spin = 0.0;

  Outline2 at(double time) const {
    Outline2 now = turned_by(outline, spin * time);
    for (Vec2& corner : now) corner += from + time * velocity;
    return now;
  }
  /// No point of it is faster [m/s].
  double fastest() const {
    double radius = 0.0;
    for (const Vec2 corner : outline) radius = std::max(radius, length(corner));
    return length(velocity) + std::fabs(spin) * radius;
  }
};

/// Least room between two movers in a time, to 0.02 mm [m]; below `enough` any room that is found.
double least_room(const Mover& a, const Mover& b, double begin, double end, double enough, double least = 1e300) {
  constexpr double tolerance = 2e-5;
  const double middle = 0.5 * (begin + end);
  const double now = room(a.at(middle), b.at(middle));
  least = std::min(least, now);
  const double change = 0.5 * (end - begin) * (a.fastest() + b.fastest());
  if (least < enough || now - change >= least - tolerance) return least;
  least = least_room(a, b, begin, middle, enough, least);
  return least < enough ? least : least_room(a, b, middle, end, enough, least);
}

Outline2 ship() { return {{-40, -10}, {20, -10}, {40, -3}, {45, 0}, {40, 3}, {20, 10}, {-40, 10}}; }

struct Obstacle {
  std::string name;
  Outline2 outline;
};

std::vector<Obstacle> obstacles() {
  return {{"square", rectangle(10.0, 10.0)},
          {"ship", ship()},
          {"leg", regular(12, 2.0)},
          {"20-gon", regular(20, 50.0)},
          {"slanted floe", turned_by(rectangle(8.0, 5.0), 0.4)}};
}

double top_of(const Outline2& outline) {
  double top = -1e300;
  for (const Vec2 corner : outline) top = std::max(top, corner.y);
  return top;
}
double bottom_of(const Outline2& outline) { return -top_of(turned_by(outline, M_PI)); }

/// A floe that passes above the obstacle with `clearance` [m] to spare in `duration`; every other one spins.
Mover passing(const Obstacle& obstacle, RandomSequence& numbers, double clearance, double duration, bool spins) {
  constexpr double speed = 1.0;
  Mover floe{turned_by(rectangle(numbers.uniform(3.0, 9.0), numbers.uniform(3.0, 9.0)), numbers.uniform(0.0, 6.0)),
             {-0.5 * speed * duration + 0.1 * numbers.uniform(), 0.0},
             {speed, 0.0},
             spins ? numbers.uniform(-0.3, 0.3) : 0.0};
  floe.from.y = top_of(obstacle.outline) - bottom_of(floe.outline) + clearance;
  if (!spins) return floe;
  const Mover still{obstacle.outline, {}, {}, 0.0};
  double low = top_of(obstacle.outline), high = low + 8.0;
  while (high - low > 1e-5) {
    floe.from.y = 0.5 * (low + high);
    (least_room(floe, still, 0.0, duration, clearance) < clearance ? low : high) = floe.from.y;
  }
  floe.from.y = high;
  return floe;
}

FloeDef floe_of(const Mover& mover) { return hits::floe_of(mover.outline, mover.from, mover.velocity, mover.spin); }

Vec2 centroid_of(const Outline2& outline) {
  double area = 0.0;
  Vec2 sum;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    area += 0.5 * cross(a, b);
    sum += (cross(a, b) / 6.0) * (a + b);
  }
  return (1.0 / area) * sum;
}

enum class Kind { platform, fixed, floe };

SceneDef scene_of(const Mover& floe, const Obstacle& obstacle, Kind kind) {
  SceneDef scene = open_scene();
  scene.floe = {floe_of(floe)};
  if (kind == Kind::fixed) scene.fixed = {{obstacle.outline}};
  if (kind == Kind::floe) scene.floe.push_back(hits::floe_of(obstacle.outline, {}));
  if (kind == Kind::platform) {
    scene.platform.present = true;
    scene.platform.outline = PlatformOutline::listed;
    scene.platform.outline_m = obstacle.outline;
    scene.platform.anchor_m = centroid_of(obstacle.outline);
  }
  return scene;
}

/// Passes of all obstacles; returns how many changed a bit of the floe that passes.
int disturbed_passes(int phases, double most_room) {
  RandomSequence numbers(Random(11, 1));
  int disturbed = 0;
  for (const Obstacle& obstacle : obstacles())
    for (int k = 0; k < phases; ++k) {
      double reach = 0.0;
      for (const Vec2 corner : obstacle.outline) reach = std::max(reach, std::fabs(corner.x));
      const double duration = 2.0 * (reach + 8.0);
      const double clearance = k % 2 ? 1e-3 : numbers.uniform(1e-3, most_room);
      const Mover floe = passing(obstacle, numbers, clearance, duration, k % 4 >= 2);
      SceneDef scene = scene_of(floe, obstacle, static_cast<Kind>(k % 3));
      SceneDef alone = open_scene();
      alone.floe = {scene.floe[0]};
      Trial run(scene), free(alone);
      run.advance_for(scene, duration);
      free.advance_for(alone, duration);
      const bool same = same_bits(run.bodies(), first_floe(run.bodies()), free.bodies(), first_floe(free.bodies()));
      EXPECT_TRUE(same) << obstacle.name << ", pass " << k << ", room " << 1e3 * clearance << " mm";
      EXPECT_EQ(run.engine->ledger().contact.load, 0.0) << obstacle.name << ", pass " << k;
      disturbed += !same;
    }
  return disturbed;
}

// the floe travels 0.1 m in a time step
TEST(ContactMiss, passing_changes_no_bit) { EXPECT_EQ(disturbed_passes(12, 0.1), 0); }

TEST(LongContactMiss, passing_changes_no_bit) { EXPECT_EQ(disturbed_passes(600, 0.1), 0); }

TEST(ContactMiss, passing_under_the_drag_of_a_current_changes_no_bit) {
  for (int phase = 0; phase < 10; ++phase) {
    SceneDef alone = open_scene();
    alone.water = {};
    alone.current.velocity_m_per_s = {0.7, 0.0};
    alone.floe = {hits::floe_of(rectangle(6.0, 6.0), {-12.0 + 0.01 * phase, 0.0}, {0.3, 0.0})};
    SceneDef scene = alone;
    scene.fixed = {{{{-5.0, 3.001}, {5.0, 3.001}, {5.0, 9.0}, {-5.0, 9.0}}}};
    Trial run(scene), free(alone);
    run.advance(600);
    free.advance(600);
    EXPECT_GT(run.bodies().position[first_floe(run.bodies())].x, 9.0);
    EXPECT_TRUE(same_bits(run.bodies(), first_floe(run.bodies()), free.bodies(), first_floe(free.bodies()))) << phase;
  }
}

TEST(ContactMiss, room_of_0999_mm_closed_by_1_mm_is_a_hit) {
  for (int phase = 0; phase < 20; ++phase)
    for (const bool corner : {false, true}) {
      constexpr double speed = 0.01;
      SceneDef scene = open_scene();
      const Outline2 outline = corner ? rhombus(4.0, 0.5 * M_PI) : rectangle(4.0, 4.0);
      double reach = 0.0;
      for (const Vec2 c : outline) reach = std::max(reach, c.x);
      scene.numerics.time_step_s = 0.1 / (1 + 0.3 * phase);
      scene.fixed = {wall_body()};
      scene.floe = {hits::floe_of(outline, {-reach - 0.999e-3, 0.0}, {speed, 0.0})};
      Trial run(scene);
      // the force comes in the substep after the overlap
      while (static_cast<double>(run.engine->step()) * scene.numerics.time_step_s < 0.1 - 1e-12) run.advance();
      run.advance();
      EXPECT_GT(run.engine->ledger().contact.load, 0.0) << phase << (corner ? " corner" : " face");
      EXPECT_LT(run.bodies().velocity[first_floe(run.bodies())].x, speed);
    }
}

}  // namespace
}  // namespace gem::hits
