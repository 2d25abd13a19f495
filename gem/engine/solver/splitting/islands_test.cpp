// Iterations by operator splitting: a row at a wall, a light body in a load path, islands.
#include "gem/engine/solver/splitting/islands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "gem/engine/solver/iteration_control.h"
#include "gem/engine/solver/splitting/island_gradient.h"
#include "gem/engine/solver/splitting/island_view.h"
#include "gem/engine/solver/splitting/round_control.h"

namespace gem {
namespace {

constexpr double mass = 2e4, inertia = 1e5, speed = 0.5;

/// A row of bodies that runs into a wall on its left, each with one point towards its left neighbour.
struct Row {
  std::vector<IslandBody> bodies;
  std::vector<PointGeometry<double>> geometry;
  std::vector<PointImpulse<double>> impulse;

  Row(int count, double offset) : geometry(count), impulse(count) {
    for (int i = 0; i < count; ++i)
      bodies.push_back({{offset + i, 0.0}, {-speed, 0.1 * speed}, 0.0, {1.0 / mass, 1.0 / inertia}});
    for (PointGeometry<double>& g : geometry) {
      g.normal_x = 1.0;
      g.friction = 0.3;
      g.cap = 1e30;
    }
  }

  void add_to(Islands& islands, std::int32_t body, std::int32_t point) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const auto k = static_cast<std::int32_t>(i);
      set_compliance(geometry[i], divided_inverse(i) + (i > 0 ? divided_inverse(i - 1) : 0.0), 0.0, 0.0);
      islands.set_body(body + k, bodies[i]);
      islands.set_point(point + k,
                        {k == 0 ? Islands::fixed : body + k - 1, body + k, &geometry[i], &impulse[i], {}, true});
    }
  }

  /// Inverse mass of a body, divided among its points [1/kg].
  double divided_inverse(std::size_t i) const { return (i + 1 < bodies.size() ? 2.0 : 1.0) * bodies[i].inverse.mass; }

  /// Velocity of a body with the impulses of its points [m/s].
  double velocity_after(std::size_t i) const {
    const double behind = i + 1 < impulse.size() ? impulse[i + 1].normal : 0.0;
    return bodies[i].velocity.x + (impulse[i].normal - behind) * bodies[i].inverse.mass;
  }
};

/// As a scene sets it whose residual tolerance is so much of `speed`.
IslandControl control_of(double tolerance, std::int64_t iterations_maximum) {
  return {PointFriction::coulomb, tolerance, 0.2, iterations_maximum,
          tolerance >= IterationControl::single_precision * speed};
}

IslandResult solve(Islands& islands, const IslandControl& control) {
  islands.find();
  islands.solve(control, 0);
  return islands.worst();
}

class RowAtAWall : public testing::TestWithParam<double> {};

TEST_P(RowAtAWall, StopsWithinItsTolerance) {
  constexpr int count = 100;
  const IslandControl control = control_of(GetParam(), 5000);
  Row row(count, 0.0);
  Islands islands;
  islands.begin(count, count, 1);
  row.add_to(islands, 0, 0);
  const IslandResult result = solve(islands, control);
  EXPECT_LE(result.error, control.tolerance);
  EXPECT_LT(result.iterations, control.iterations_maximum);
  // the tolerance holds for every body: the wall stops all of them, and so may be off by all of their masses
  EXPECT_NEAR(row.impulse[0].normal, count * mass * speed, count * mass * control.tolerance);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(row.velocity_after(i), 0.0, control.tolerance) << i;
}

INSTANTIATE_TEST_SUITE_P(Tolerances, RowAtAWall, testing::Values(1e-3, 1e-5, 1e-9, 1e-12),
                         [](const testing::TestParamInfo<double>& one) {
                           return "of_1e_" + std::to_string(std::lround(-std::log10(one.param)));
                         });

TEST(Islands, LoadPassesThroughALightBody) {
  Row row(40, 0.0);
  for (const int light : {7, 20, 33}) row.bodies[light].inverse = {1e3 / mass, 1e4 / inertia};
  Islands islands;
  islands.begin(40, 40, 1);
  row.add_to(islands, 0, 0);
  const IslandControl control = control_of(1e-3, 5000);
  const IslandResult result = solve(islands, control);
  EXPECT_LE(result.error, control.tolerance);
  for (int i = 0; i < 40; ++i) EXPECT_NEAR(row.velocity_after(i), 0.0, control.tolerance) << i;
}

TEST(Islands, KeepImpulsesThatStillHold) {
  constexpr int count = 30;
  Row row(count, 0.0);
  Islands islands;
  islands.begin(count, count, 1);
  row.add_to(islands, 0, 0);
  IslandControl control = control_of(1e-9, 5000);
  ASSERT_GT(solve(islands, control).iterations, 0);
  const std::vector<PointImpulse<double>> solved = row.impulse;
  // only the point at the wall asks for more
  for (IslandBody& b : row.bodies) b.velocity.x *= 1.0 + 1e-5;
  const double asked = 1e-5 * speed;
  for (const double share : {0.9, 1.1}) {
    row.impulse = solved;
    const double tolerance = 4.0 * asked / share;
    control.tolerance = 32.0 * tolerance;  // of a chain: IslandSize::tolerance()
    islands.begin(count, count, 1);
    row.add_to(islands, 0, 0);
    const IslandResult result = solve(islands, control);
    EXPECT_LE(result.error, tolerance);
    EXPECT_EQ(result.iterations == 0, share < 1.0) << share;
    for (int i = 0; i < count; ++i) EXPECT_NEAR(row.velocity_after(i), 0.0, tolerance) << i;
    EXPECT_EQ(row.impulse[0].normal == solved[0].normal, share < 1.0);
  }
}

TEST(Islands, AreNotSettledByASumThatIsCutOff) {
  // as the threads of the largest cluster of blocks add up
  constexpr double tolerance = 1e-3;
  for (const int threads : {4096, 8192}) {
    decltype(IslandCell::asked) sum = 0;
    for (int k = 0; k < threads; ++k) sum += RoundControl::asked(tolerance, 2e-3F);
    EXPECT_GT(RoundControl::error_of_base(tolerance, sum), tolerance) << threads;
  }
}

TEST(Islands, DependOnThemselvesAlone) {
  const IslandControl control = control_of(1e-5, 2000);
  Row alone(30, 0.0), here(30, 0.0), far(70, 5000.0);
  Islands one, two;
  one.begin(30, 30, 1);
  alone.add_to(one, 0, 0);
  solve(one, control);
  two.begin(100, 100, 1);
  far.add_to(two, 0, 0);
  here.add_to(two, 70, 70);
  solve(two, control);
  for (int i = 0; i < 30; ++i) {
    ASSERT_GT(alone.impulse[i].normal, 0.0);
    EXPECT_EQ(alone.impulse[i].normal, here.impulse[i].normal);
    EXPECT_EQ(alone.impulse[i].tangential, here.impulse[i].tangential);
  }
}

TEST(Islands, TakeNoAnswerThatIsNotANumber) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (int body = 0; body < 5; ++body) {
      Row row(5, 0.0);
      row.bodies[body].velocity.x = bad;
      Islands islands;
      islands.begin(5, 5, 1);
      row.add_to(islands, 0, 0);
      const IslandControl control = control_of(1e-3, 96);
      EXPECT_FALSE(solve(islands, control).error <= control.tolerance) << body;
    }
  }
}

/// Square bodies, side by side in a corner of two walls, that are pushed into it. Each face has two points.
struct Block {
  static constexpr int side = 10;
  static constexpr double half = 0.5, arm = 0.4, light = 0.05;  // [m], [m], share of the mass of every seventh body
  std::vector<IslandBody> bodies;
  std::vector<PointGeometry<double>> geometry;
  std::vector<std::pair<int, int>> ends;
  std::vector<PointImpulse<double>> impulse;
  std::vector<Motion<double>> motion;

  Block() {
    for (int k = 0; k < side * side; ++k) {
      const double m = mass * (k % 7 == 0 ? light : 1.0);
      bodies.push_back({{1.0 * (k % side), 1.0 * (k / side)}, {-speed, -0.5 * speed}, 0.0, {1.0 / m, 6.0 / m}});
      motion.push_back({-speed, -0.5 * speed, 0.0, 0.0, 0.0, 0.0});
    }
    for (int k = 0; k < side * side; ++k) {
      add_face(k % side == 0 ? Islands::fixed : k - 1, k, {1.0, 0.0});
      add_face(k < side ? Islands::fixed : k - side, k, {0.0, 1.0});
    }
    impulse.resize(ends.size());
    std::vector<int> count(bodies.size());
    for (const auto& [a, b] : ends) {
      if (a != Islands::fixed) ++count[a];
      ++count[b];
    }
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const auto [a, b] = ends[k];
      const InverseMass of_a = a == Islands::fixed ? InverseMass{} : bodies[a].inverse, of_b = bodies[b].inverse;
      const double from_a = a == Islands::fixed ? 0.0 : count[a];
      set_compliance(geometry[k], from_a * of_a.mass + count[b] * of_b.mass, from_a * of_a.inertia,
                     count[b] * of_b.inertia);
    }
  }

  void add_face(int a, int b, Vec2 normal) {
    for (const double at : {-arm, arm}) {
      PointGeometry<double> g{};
      g.normal_x = normal.x;
      g.normal_y = normal.y;
      const Vec2 tangent{-normal.y, normal.x}, from_b = -half * normal + at * tangent,
                                               from_a = half * normal + at * tangent;
      g.lever_a_n = cross(from_a, normal);
      g.lever_a_t = cross(from_a, tangent);
      g.lever_b_n = cross(from_b, normal);
      g.lever_b_t = cross(from_b, tangent);
      g.friction = 0.3;
      g.cap = 1e30;
      geometry.push_back(g);
      ends.emplace_back(a, b);
    }
  }

  IslandPoint point(std::size_t k) {
    return {ends[k].first, ends[k].second, &geometry[k], &impulse[k], {}, k % 2 == 0};  // two points a face
  }

  /// Largest speed of a body with the impulses of its points [m/s].
  double fastest() const {
    std::vector<Push<double>> push(bodies.size());
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const PointGeometry<double>& g = geometry[k];
      add(push[ends[k].second], 1.0, push_of(g, impulse[k], g.lever_b_n, g.lever_b_t));
      if (ends[k].first != Islands::fixed)
        add(push[ends[k].first], -1.0, push_of(g, impulse[k], g.lever_a_n, g.lever_a_t));
    }
    double largest = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const IslandBody& b = bodies[i];
      const Motion<double> m = moved_by(push[i], b.velocity.x, b.velocity.y, b.spin, b.inverse.mass, b.inverse.inertia);
      largest = std::max({largest, std::abs(m.x), std::abs(m.y)});
    }
    return largest;
  }
};

/// Solves a block as islands do.
IslandResult solve(Block& block, const IslandControl& control) {
  const auto bodies = static_cast<std::int32_t>(block.bodies.size());
  const auto points = static_cast<std::int32_t>(block.ends.size());
  Islands islands;
  islands.begin(bodies, points, 1);
  for (std::int32_t k = 0; k < bodies; ++k) islands.set_body(k, block.bodies[k]);
  for (std::int32_t k = 0; k < points; ++k) islands.set_point(k, block.point(k));
  return solve(islands, control);
}

TEST(Islands, StopABlockWithGradientIterationsAfterARound) {
  IslandControl control = control_of(1e-3, 100);  // room for one round
  Block by_gradient, by_splitting, by_both;
  std::vector<IslandPoint> points;
  for (std::size_t k = 0; k < by_gradient.ends.size(); ++k) points.push_back(by_gradient.point(k));
  IslandResult result;
  EXPECT_FALSE(IslandGradient().solve(by_gradient.bodies, points, by_gradient.motion, control, true, result));
  EXPECT_GT(by_gradient.fastest(), 10.0 * control.tolerance);
  control.gradient_first = false;
  EXPECT_GT(solve(by_splitting, control).error, control.tolerance);
  control.gradient_first = true;
  EXPECT_LE(solve(by_both, control).error, control.tolerance);
  EXPECT_LE(by_both.fastest(), 2.0 * control.tolerance);
}

/// A sheet of bodies that runs into walls at its left and below: loops, so splitting takes over from the gradient.
struct Sheet {
  static constexpr std::int32_t side = 24;
  std::vector<IslandBody> bodies;
  std::vector<PointGeometry<double>> geometry;
  std::vector<PointImpulse<double>> impulse;
  std::vector<std::pair<std::int32_t, std::int32_t>> ends;

  Sheet() {
    for (std::int32_t i = 0; i < side * side; ++i)
      bodies.push_back({{1.0 * (i % side), 1.0 * (i / side)},
                        {-speed * (1.0 + 0.1 * (i % 7)), -speed},
                        0.02 * (i % 5),
                        {1.0 / (mass * (1.0 + i % 3)), 1.0 / (inertia * (1.0 + i % 3))}});
    for (std::int32_t i = 0; i < side * side; ++i) {
      add(i % side == 0 ? Islands::fixed : i - 1, i, {1.0, 0.0});
      add(i < side ? Islands::fixed : i - side, i, {0.0, 1.0});
    }
    impulse.resize(ends.size());
  }

  void add(std::int32_t a, std::int32_t b, Vec2 normal) {
    PointGeometry<double> g{};
    g.normal_x = normal.x;
    g.normal_y = normal.y;
    g.lever_a_n = 0.1;
    g.lever_a_t = 0.5;
    g.lever_b_n = -0.1;
    g.lever_b_t = -0.5;
    g.friction = 0.3;
    g.cap = 1e30;
    g.repair_target = b % 4 == 0 ? 1e-3 : 0.0;
    set_compliance(g, 4.0 / mass, 4.0 / inertia, 4.0 / inertia);
    geometry.push_back(g);
    ends.emplace_back(a, b);
  }

  /// Impulses after a solution by so many threads.
  std::vector<PointImpulse<double>> solved_by(int threads) {
    Islands islands;
    islands.begin(side * side, static_cast<std::int32_t>(ends.size()), threads);
    for (std::int32_t k = 0; k < side * side; ++k) islands.set_body(k, bodies[k]);
    for (std::size_t k = 0; k < ends.size(); ++k)
      islands.set_point(static_cast<std::int32_t>(k),
                        {ends[k].first, ends[k].second, &geometry[k], &impulse[k], {}, true});
    islands.find();
    std::vector<std::thread> helpers;
    for (int rank = 1; rank < threads; ++rank)
      helpers.emplace_back([&islands, rank] { islands.solve(control_of(1e-4, 192), rank); });
    islands.solve(control_of(1e-4, 192), 0);
    for (std::thread& helper : helpers) helper.join();
    EXPECT_GT(islands.worst().iterations, 32);
    return impulse;
  }
};

TEST(Islands, OfAnyNumberOfThreadsHaveTheSameBits) {
  const std::vector<PointImpulse<double>> one = Sheet().solved_by(1);
  for (const int threads : {2, 3, 5}) {
    const std::vector<PointImpulse<double>> some = Sheet().solved_by(threads);
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(one[k].normal, some[k].normal) << threads << " threads, point " << k;
      EXPECT_EQ(one[k].tangential, some[k].tangential) << threads << " threads, point " << k;
      EXPECT_EQ(one[k].repair, some[k].repair) << threads << " threads, point " << k;
    }
  }
}

// Iterations that a jam keeps where they end at their last one, but not where they ran away.
TEST(Islands, KeepNoGradientIterationsThatRanAway) {
  for (const double velocity : {1.0, 1e30, std::nan("")}) {
    Sheet sheet;
    sheet.bodies[7].velocity.x = velocity;
    std::vector<IslandPoint> points;
    std::vector<Motion<double>> motion;
    for (std::size_t k = 0; k < sheet.ends.size(); ++k)
      points.push_back({sheet.ends[k].first, sheet.ends[k].second, &sheet.geometry[k], &sheet.impulse[k], {}, true});
    for (const IslandBody& b : sheet.bodies) motion.push_back({b.velocity.x, b.velocity.y, b.spin, 0.0, 0.0, 0.0});
    IslandControl control = control_of(1e-6, 40);
    control.jam = true;
    IslandResult result;
    EXPECT_FALSE(IslandGradient().solve(sheet.bodies, points, motion, control, true, result));
    const bool stayed = std::all_of(sheet.impulse.begin(), sheet.impulse.end(), [](const PointImpulse<double>& i) {
      return i.normal == 0.0 && i.tangential == 0.0 && i.repair == 0.0;
    });
    EXPECT_EQ(stayed, velocity != 1.0) << velocity;
  }
}

}  // namespace
}  // namespace gem
