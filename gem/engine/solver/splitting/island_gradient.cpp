#include "gem/engine/solver/splitting/island_gradient.h"

#include <algorithm>

namespace gem {

void IslandGradient::set(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                         std::span<const Motion<double>> motion) {
  now_.assign(bodies.size() + 1, BodyRow{});
  sum_.assign(bodies.size() + 1, BodyRow{});
  inverse_.assign(bodies.size() + 1, BodyRow{});
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const ScaledBody b = scaled_body(bodies[k].inverse);
    const float mass = 1.0F / b.mass, inertia = 1.0F / b.inertia;
    inverse_[k + 1].lanes = FloatPack{mass, mass, inertia, 0.0F, mass, mass, inertia, 0.0F};
  }
  block_.assign((points.size() + float_lanes - 1) / float_lanes, Block{});
  repairs_ = false;
  const Motion<double> rest{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const IslandPoint& p = points[k];
    const bool fixed_a = p.a == IslandPoint::fixed, fixed_b = p.b == IslandPoint::fixed;
    Block& q = block_[k / float_lanes];
    const int lane = static_cast<int>(k % float_lanes);
    q.a[lane] = fixed_a ? 0 : 1 + p.a;
    q.b[lane] = fixed_b ? 0 : 1 + p.b;
    set_gradient_point(q, lane, *p.geometry, fixed_a ? InverseMass{} : bodies[p.a].inverse,
                       fixed_b ? InverseMass{} : bodies[p.b].inverse, p.spare, *p.impulse, fixed_a ? rest : motion[p.a],
                       fixed_b ? rest : motion[p.b]);
    repairs_ = repairs_ || repairs(*p.geometry, *p.impulse);
  }
}

/// Sets the motions that the extrapolated additions give.
GEM_CLONES void IslandGradient::move() {
  for (std::size_t k = 1; k < now_.size(); ++k) {
    now_[k].lanes = inverse_[k].lanes * sum_[k].lanes;
    sum_[k] = BodyRow{};
  }
}

template <PointFriction law, bool judged, bool repairs>
GEM_INLINE GradientAsked IslandGradient::visit_blocks(const Pace& pace) {
  FloatPack largest{};
  FloatMask sum{};
  for (Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(now_, q.a, a);
    load_motions<0>(now_, q.b, b);
    FloatPack asked = visit_gradient<law, judged>(q, a, b, pace.momentum_coefficient);
    if constexpr (repairs) {
      load_motions<1>(now_, q.a, a);
      load_motions<1>(now_, q.b, b);
      const FloatPack shift = visit_gradient_repair<judged>(q, a, b, pace.momentum_coefficient);
      if constexpr (judged) asked = larger(asked, pace.per_step * shift);
    }
    add_pushes<repairs>(q, {q.ahead_n, q.ahead_t}, {q.ahead_r, FloatPack{}}, sum_);
    if constexpr (judged) {
      largest = larger(largest, asked);
      const FloatPack units =
          smaller(pace.units * asked, FloatPack{} + static_cast<float>(GradientControl::too_many_units));
      sum += __builtin_convertvector(units, FloatMask) - (asked > FloatPack{});  // a comparison that holds is -1
      sum = sum < GradientControl::too_many_units ? sum : FloatMask{} + GradientControl::too_many_units;
    }
  }
  GradientAsked all;
  for (int lane = 0; lane < float_lanes; ++lane) {
    all.sum += static_cast<std::uint64_t>(sum[lane]);
    all.largest = larger(all.largest, largest[lane]);
  }
  return all;
}

template <PointFriction law>
GEM_INLINE GradientAsked IslandGradient::visit_law(bool judged, const Pace& pace) {
  if (judged) return repairs_ ? visit_blocks<law, true, true>(pace) : visit_blocks<law, true, false>(pace);
  return repairs_ ? visit_blocks<law, false, true>(pace) : visit_blocks<law, false, false>(pace);
}

GEM_CLONES GradientAsked IslandGradient::visit_frictionless(bool judged, const Pace& pace) {
  return visit_law<PointFriction::none>(judged, pace);
}
GEM_CLONES GradientAsked IslandGradient::visit_coulomb(bool judged, const Pace& pace) {
  return visit_law<PointFriction::coulomb>(judged, pace);
}
GEM_CLONES GradientAsked IslandGradient::visit_fixed_direction(bool judged, const Pace& pace) {
  return visit_law<PointFriction::fixed_direction>(judged, pace);
}

GradientAsked IslandGradient::visit(PointFriction law, bool judged, const Pace& pace) {
  if (law == PointFriction::none) return visit_frictionless(judged, pace);
  if (law == PointFriction::coulomb) return visit_coulomb(judged, pace);
  return visit_fixed_direction(judged, pace);
}

bool IslandGradient::solve(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                           std::span<const Motion<double>> motion, const IslandControl& control, bool keeps,
                           IslandResult& result) {
  set(bodies, points, motion);
  GradientControl course(control.tolerance, control.iterations_maximum, control.jam);
  Pace pace{0.0F, static_cast<float>(1.0 / control.dt), course.units()};
  auto next = GradientControl::Next::iteration;
  for (;;) {
    pace.momentum_coefficient = course.begin_iteration();
    const bool judged = course.judged();
    const GradientAsked asked = visit(control.friction, judged, pace);
    if (judged) next = course.after(asked);
    if (next != GradientControl::Next::iteration) break;
    move();
  }
  const bool done = next == GradientControl::Next::done;
  const bool kept = keeps && !course.ran_away();
  if (done || kept)
    for (std::size_t k = 0; k < points.size(); ++k)
      *points[k].impulse = with_answer(block_[k / float_lanes], static_cast<int>(k % float_lanes), control.friction,
                                       *points[k].geometry, points[k].spare, *points[k].impulse);
  if (done) {
    result.iterations = std::max(result.iterations, course.iteration());
    result.error = course.error();
  } else if (kept) {
    result.error = larger(result.error, course.largest_asked());
  }
  return done;
}

}  // namespace gem
