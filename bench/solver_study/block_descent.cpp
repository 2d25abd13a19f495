// Augmented vertex block descent for velocities, after Giles, Diaz and Yuksel (2025).
//
// For each body in turn, by colour, its velocity x minimises
//     1/2 (x - x0)^T M (x - x0)  +  sum over its points of  1/2 k (c + P / k)^2 where a point pushes,
// c the speed by which the point misses its law; after all bodies P := P + k c, projected, and k grows by `growth` with
// every visit that leaves P inside its limits. Repair in the same way. The impulses, not the velocities, are handed on,
// so that momentum is kept.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "bench/solver_study/method.h"

namespace gem::bench {
namespace {

using Vec3 = std::array<double, 3>;

/// Solves the symmetric 3 x 3 system of one body.
struct Normal3 {
  double xx = 0, xy = 0, xs = 0, yy = 0, ys = 0, ss = 0;
  Vec3 right{};

  void add(const Vec3& j, double stiffness, double force) {
    xx += stiffness * j[0] * j[0];
    xy += stiffness * j[0] * j[1];
    xs += stiffness * j[0] * j[2];
    yy += stiffness * j[1] * j[1];
    ys += stiffness * j[1] * j[2];
    ss += stiffness * j[2] * j[2];
    for (int i = 0; i < 3; ++i) right[i] += force * j[i];
  }
  Vec3 solved() const {
    const double l21 = xy / xx, l31 = xs / xx, d2 = yy - l21 * xy, l32 = (ys - l31 * xy) / d2;
    const double d3 = ss - l31 * xs - l32 * l32 * d2;
    const double y2 = right[1] - l21 * right[0], y3 = right[2] - l31 * right[0] - l32 * y2;
    const double s = y3 / d3, y = y2 / d2 - l32 * s, x = right[0] / xx - l21 * y - l31 * s;
    return {x, y, s};
  }
};

class BlockDescent : public Method {
 public:
  BlockDescent(const Problem& problem, Impulses start, double growth, double stiffest)
      : Method(problem, std::move(start)),
        growth_(growth),
        stiffest_(stiffest),
        motions_(motions_of(problem, impulses_)),
        stiffness_(problem.points(), 1.0),
        points_of_(problem.bodies()) {
    for (std::size_t k = 0; k < problem.points(); ++k) {
      points_of_[problem.point[k].a].push_back(static_cast<std::int32_t>(k));
      points_of_[problem.point[k].b].push_back(static_cast<std::int32_t>(k));
    }
    colour_bodies();
  }

  void pass() override {
    for (const std::int32_t body : order_) minimise(body);
    for (std::size_t k = 0; k < problem_.points(); ++k) {
      const PointImpulse<double> next = augmented(k);
      const StudiedPoint& g = problem_.point[k].own;
      if (next.normal > 0.0 && next.normal < g.cap) stiffness_[k] = std::min(growth_ * stiffness_[k], stiffest_);
      impulses_[k] = next;
    }
  }
  std::int64_t phases_per_pass() const override { return colours_ + 1; }

 private:
  void colour_bodies() {
    std::vector<std::int32_t> colour(problem_.bodies(), -1);
    for (std::size_t i = 0; i < problem_.bodies(); ++i) {
      if (points_of_[i].empty() || !(problem_.inverse_mass[i] > 0.0)) continue;
      std::uint64_t used = 0;
      for (const std::int32_t k : points_of_[i]) {
        const ProblemPoint& point = problem_.point[k];
        const std::int32_t other = colour[point.a == static_cast<std::int32_t>(i) ? point.b : point.a];
        if (other >= 0) used |= std::uint64_t{1} << other;
      }
      colour[i] = std::countr_one(used);
      colours_ = std::max<std::int64_t>(colours_, colour[i] + 1);
      order_.push_back(static_cast<std::int32_t>(i));
    }
    std::stable_sort(order_.begin(), order_.end(), [&](int i, int j) { return colour[i] < colour[j]; });
  }

  /// Impulse of a point at the velocities as they are.
  PointImpulse<double> augmented(std::size_t k) const {
    const ProblemPoint& point = problem_.point[k];
    StudiedPoint g = point.own;
    g.inverse_nn *= stiffness_[k];
    g.inverse_tt *= stiffness_[k];
    g.nt = 0.0;
    PointImpulse<double> next = impulses_[k], carried = next;
    visit_studied<PointFriction::coulomb>(g, motions_[point.a], motions_[point.b], problem_.dt, 1.0 / problem_.dt, 0.0,
                                          next, carried);
    return next;
  }

  void minimise(std::int32_t body) {
    Motion<double>& m = motions_[body];
    const double mass = problem_.mass[body], inertia = 1.0 / problem_.inverse_inertia[body];
    Normal3 move, repair;
    move.add({1, 0, 0}, mass, mass * (problem_.velocity[body].x - m.x));
    move.add({0, 1, 0}, mass, mass * (problem_.velocity[body].y - m.y));
    move.add({0, 0, 1}, inertia, inertia * (problem_.spin[body] - m.spin));
    repair.add({1, 0, 0}, mass, -mass * m.shift_x);
    repair.add({0, 1, 0}, mass, -mass * m.shift_y);
    repair.add({0, 0, 1}, inertia, -inertia * m.turn);
    for (const std::int32_t k : points_of_[body]) {
      const ProblemPoint& point = problem_.point[k];
      const StudiedPoint& g = point.own;
      const PointImpulse<double> p = augmented(k);
      const bool is_b = point.b == body;
      const double sign = is_b ? 1.0 : -1.0;
      const Vec3 n{sign * g.normal_x, sign * g.normal_y, sign * (is_b ? g.lever_b_n : g.lever_a_n)};
      const Vec3 t{-sign * g.normal_y, sign * g.normal_x, sign * (is_b ? g.lever_b_t : g.lever_a_t)};
      const bool pushes = p.normal > 0.0 && p.normal < g.cap, sticks = std::fabs(p.tangential) < g.friction * p.normal;
      move.add(n, pushes ? stiffness_[k] * g.inverse_nn : 0.0, p.normal);
      move.add(t, sticks ? stiffness_[k] * g.inverse_tt : 0.0, p.tangential);
      repair.add(n, p.repair > 0.0 ? stiffness_[k] * g.inverse_nn : 0.0, p.repair);
    }
    const Vec3 v = move.solved(), s = repair.solved();
    m = {m.x + v[0], m.y + v[1], m.spin + v[2], m.shift_x + s[0], m.shift_y + s[1], m.turn + s[2]};
  }

  const double growth_, stiffest_;
  Motions motions_;
  std::vector<double> stiffness_;  // times the point's own [-]
  std::vector<std::vector<std::int32_t>> points_of_;
  std::vector<std::int32_t> order_;
  std::int64_t colours_ = 0;
};

}  // namespace

Candidate block_descent(const std::string& name, double growth, double stiffest) {
  return {name, [growth, stiffest](const Problem& problem, Impulses start) {
            return std::make_unique<BlockDescent>(problem, std::move(start), growth, stiffest);
          }};
}

}  // namespace gem::bench
