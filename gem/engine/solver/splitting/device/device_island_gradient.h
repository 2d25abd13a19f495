// Gradient iterations of the points of one island on a device, by the threads of a team: IslandGradient
// (island_gradient.h) with the same sums in the same order.
#pragma once

#include "gem/engine/solver/splitting/device/device_island_points.h"
#include "gem/engine/solver/splitting/gradient_control.h"
#include "gem/engine/solver/splitting/gradient_point.h"

namespace gem {

template <class Team>
class DeviceIslandGradient : private DeviceIslandPoints<Team> {
 public:
  using DeviceIslandPoints<Team>::DeviceIslandPoints;

  /// Makes the places of bodies and points those without an order of elimination: in the order of the bodies.
  GEM_DEVICE void place_by_body() {
    each_of(team_, 0, v_.bodies, [&](std::int32_t i) {
      const SolverEntry& entry = this->entry_of(i);
      const BodyCell& body = s_.body[entry.body];
      v_.m.scaled[i] = scaled_body({body.inverse_mass, body.inverse_inertia});
      v_.m.records[i] = {entry.place, entry.count, entry.as_b, 0};
    });
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      const PointCell& cell = s_.taken_point[v_.m.where[k].taken];
      const auto body_of = [&](const PointSide& side) {
        return side.place < 0 ? -1 : s_.island.index[s_.island.rank[side.body]];
      };
      v_.m.ends[k].a = body_of(cell.a);
      v_.m.ends[k].b = body_of(cell.b);
    });
  }

  /// What gradient iterations do in this island. Notes whether they join the rounds. All threads call it.
  GEM_DEVICE GradientPlan make_plan() {
    if (team_.rank() == 0) cell_.bodies_bits = cell_.change_bits = 0;
    team_.sync();
    float mass = 0.0F, inverse_mass = 0.0F;
    each_of(team_, 0, v_.bodies, [&](std::int32_t i) {
      const double inverse = s_.body[this->entry_of(i).body].inverse_mass;
      mass = larger(mass, static_cast<float>(1.0 / inverse));
      inverse_mass = larger(inverse_mass, static_cast<float>(inverse));
    });
    this->raise_to(&cell_.bodies_bits, mass);
    this->raise_to(&cell_.change_bits, inverse_mass);
    team_.sync();
    GradientPlan plan;
    if (!s_.constants.tight_residual)
      plan = gradient_plan(v_.size(), from_ordered_bits(cell_.bodies_bits), from_ordered_bits(cell_.change_bits),
                           s_.constants.iterations_maximum);
    if (team_.rank() == 0) cell_.joins_rounds = plan.joins_rounds;
    team_.sync();  // the numbers are free again
    return plan;
  }

  /// Iterates until the tolerance is met, or until that takes too long. The places are set, and the motions of the
  /// bodies at the base. `iterations`, `error`: of splitting before. Returns whether the tolerance was met, and notes
  /// the error if so. `keeps`: whether what was reached is the next base if not; then raises the error to what it asks
  /// for.
  GEM_DEVICE bool solve(bool keeps, std::int64_t iterations, double& error) {
    const StepConstants& c = s_.constants;
    set();
    GradientControl course(this->tolerance(), c.iterations_maximum, v_.size().is_jam());
    auto next = GradientControl::Next::iteration;
    for (;;) {
      const float momentum_coefficient = course.begin_iteration();
      const bool judged = course.judged();
      if (!judged) forget_asked();
      judged ? visit<true>(momentum_coefficient, course.units()) : visit<false>(momentum_coefficient, 0.0F);
      team_.sync();
      if (judged) next = course.after({cell_.asked, from_ordered_bits(cell_.points_bits)});
      if (next != GradientControl::Next::iteration) break;
      move();
    }
    const bool done = next == GradientControl::Next::done;
    const bool kept = keeps && !course.ran_away();
    if (done || kept) this->template add_to_base<Point>();
    if (done)
      this->note(iterations > course.iteration() ? iterations : course.iteration(), course.error());
    else if (kept)
      error = larger(error, static_cast<double>(course.largest_asked()));
    return done;
  }

 private:
  using Base = DeviceIslandPoints<Team>;
  using Point = GradientPoint<float>;
  using Base::cell_;
  using Base::s_;
  using Base::team_;
  using Base::v_;
  using typename Base::Atomics;

  GEM_DEVICE void forget_asked() {
    if (team_.rank() == 0) cell_.asked = cell_.points_bits = 0;
  }

  /// Sets points and bodies at the base. The additions are zero.
  GEM_DEVICE void set() {
    team_.sync();  // all have read the sum of the base
    if (team_.rank() == 0) cell_.repairs = 0;
    forget_asked();
    team_.sync();
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      const std::int32_t i = v_.m.where[k].taken;
      const PointCell& cell = s_.taken_point[i];
      const PointGeometry<double> g = s_.points.geometry(i);
      const PointImpulse<double> impulse = s_.points.impulse(i);
      Point q;
      set_gradient_point(q, 0, g, inverse_mass_of(s_, cell.a), inverse_mass_of(s_, cell.b), s_.points.spare(i), impulse,
                         this->motion_of(cell.a), this->motion_of(cell.b));
      store_point<gradient_fields::all>(v_, k, q);
      if (repairs(g, impulse)) Atomics::add(&cell_.repairs, 1);
    });
    each_of(team_, 0, 2 * v_.bodies, [&](std::int32_t k) { v_.m.now[k] = {}; });
    team_.sync();
    halves_ = cell_.repairs > 0 ? 2 : 1;
  }

  template <bool judged>
  GEM_DEVICE void visit(float momentum_coefficient, float units_per_speed) {
    const PointFriction law = s_.constants.point_friction;
    const auto per_step = static_cast<float>(1.0 / s_.constants.dt);
    std::uint64_t sum = 0;
    float largest = 0.0F;
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      const IslandPointEnds at = v_.m.ends[k];
      Point q = load_point<Point>(v_, k);
      float a[3], b[3];
      this->load(at.a, 0, a);
      this->load(at.b, 0, b);
      float asked = law == PointFriction::none
                        ? visit_gradient<PointFriction::none, judged>(q, a, b, momentum_coefficient)
                    : law == PointFriction::coulomb
                        ? visit_gradient<PointFriction::coulomb, judged>(q, a, b, momentum_coefficient)
                        : visit_gradient<PointFriction::fixed_direction, judged>(q, a, b, momentum_coefficient);
      this->write_push(at, q, 0, {q.ahead_n, q.ahead_t});
      if (halves_ == 2) {
        this->load(at.a, 1, a);
        this->load(at.b, 1, b);
        const float shift = visit_gradient_repair<judged>(q, a, b, momentum_coefficient);
        this->write_push(at, q, 1, {q.ahead_r, 0.0F});
        if constexpr (judged) asked = larger(asked, per_step * shift);
      }
      store_point<gradient_fields::moves>(v_, k, q);
      if constexpr (judged) {
        sum += GradientControl::units_of(asked, units_per_speed);
        largest = larger(largest, asked);
      }
    });
    if constexpr (judged) {
      if (sum > 0) Atomics::add(&cell_.asked, sum);
      this->raise_to(&cell_.points_bits, largest);
    }
  }

  /// Sets the motions that the extrapolated additions give.
  GEM_DEVICE void move() {
    each_of(team_, 0, halves_ * v_.bodies, [&](std::int32_t k) {
      const std::int32_t place = k / halves_;
      const int half = k % halves_;
      FloatQuad sum{};
      this->add_pushes(v_.m.records[place], half, sum);
      const ScaledBody& body = v_.m.scaled[place];
      const float by_mass = 1.0F / body.mass, by_inertia = 1.0F / body.inertia;
      v_.m.now[2 * place + half] = {{by_mass * sum.part[0], by_mass * sum.part[1], by_inertia * sum.part[2], 0.0F}};
    });
    team_.sync();
  }

  int halves_ = 1;  // 2: with the repair
};

}  // namespace gem
