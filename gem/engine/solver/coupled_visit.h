// The iterations of a coupled time step, point by point.
//
// With the masses shared out, the answer of one point to its own velocity cannot overshoot whatever the others do, so
// all points are visited at once from the same velocities (projected gradient in the metric of the shared masses), and
// the impulses are extrapolated along their last change (Nesterov 1983; Beck and Teboulle 2009), which takes the
// number of iterations from the square of a chain's length to its length. When the residual has grown, they begin
// again from nothing (after O'Donoghue and Candes 2015; their test sums over all points, the residual is there anyway).
// A repair that stepped against its change is not extrapolated: too much of it would open a gap.
// Tonge et al. 2012 share masses the same way.
//
// With friction the bound of a tangential impulse follows the normal one, so there is no fixed function that goes down:
// a fixed-point iteration without proof, judged by what it leaves (R1 to R3 of validation/hard).
//
// The iterations run on what is added to a base: impulses and velocities in double precision, of which each point keeps
// the numbers below in single precision. Their rounding is one of the additions, not of the whole; after a round the
// additions enter the base and the next round starts from there, so any residual can be asked for.
#pragma once

#include "gem/base/choose.h"
#include "gem/base/macros.h"
#include "gem/engine/solver/coupled_point.h"

namespace gem {

/// What a point knows while a round runs.
template <class Real>
struct PointFrame {
  Real normal_x, normal_y;
  Real lever_a_n, lever_a_t, lever_b_n, lever_b_t;  // arm x normal, arm x tangent [m]
  Real inverse_nn, inverse_tt, nt;
  Real friction;
  // at the base
  Real excess, slip;   // u_n - target, u_t [m/s]
  Real least, most;    // what may be added to P_n: -P_n and cap - P_n [N s]
  Real bytes_left;     // mu P_n - P_t [N s]
  Real bytes_right;    // mu P_n + P_t [N s]
  Real repair_excess;  // shift along the normal beyond the share of the overlap to take back [m]
  Real repair_least;   // what may be added to the repair [kg m]
};

/// Motion of B against A where all that differs between two points of a body is their levers.
template <class Real>
struct Approach {
  Real x, y, shift_x, shift_y;
  Real spin_a, turn_a, spin_b, turn_b;
};

/// What carried-ahead impulses give: the sums to B, their opposites to A.
template <class Real>
struct PointPush {
  Real x, y, shift_x, shift_y;
  Real twist_a, turn_a, twist_b, turn_b;
};

template <class Real>
GEM_HD GEM_INLINE PointPush<Real> push_of(const PointFrame<Real>& f, const PointImpulse<Real>& p) {
  return {p.normal * f.normal_x - p.tangential * f.normal_y,
          p.normal * f.normal_y + p.tangential * f.normal_x,
          p.repair * f.normal_x,
          p.repair * f.normal_y,
          p.normal * f.lever_a_n + p.tangential * f.lever_a_t,
          p.repair * f.lever_a_n,
          p.normal * f.lever_b_n + p.tangential * f.lever_b_t,
          p.repair * f.lever_b_n};
}

/// Length and pace of a time step.
template <class Scalar>
struct StepLength {
  Scalar dt;        // [s]
  Scalar per_step;  // 1 / dt [1/s]
};

/// Whether two numbers point opposite ways; no product, which could underflow.
template <class Real>
GEM_HD GEM_INLINE auto opposed(Real p, Real q) {
  const Real zero{};
  return ((p < zero) & (q > zero)) | ((p > zero) & (q < zero));
}

/// One visit: from the carried-ahead additions and the velocities that all of them give, the point's next additions,
/// and those extrapolated by `momentum_coefficient` times their change. Returns the steps from what was extrapolated.
template <PointFriction law, class Real, class Scalar>
GEM_HD GEM_INLINE PointImpulse<Real> visit_point(const PointFrame<Real>& f, const Approach<Real>& w,
                                                 StepLength<Scalar> pace, Scalar momentum_coefficient,
                                                 PointImpulse<Real>& at, PointImpulse<Real>& carried) {
  const Real zero{};
  const Real excess = w.x * f.normal_x + w.y * f.normal_y + w.spin_b * f.lever_b_n - w.spin_a * f.lever_a_n + f.excess;
  const Real normal = smaller(larger(carried.normal - excess * f.inverse_nn, f.least), f.most);
  const Real step_n = normal - carried.normal, change_n = normal - at.normal;

  Real tangential = zero, step_t = zero, change_t = zero;
  if constexpr (law == PointFriction::coulomb) {
    const Real slip = w.y * f.normal_x - w.x * f.normal_y + w.spin_b * f.lever_b_t - w.spin_a * f.lever_a_t + f.slip;
    const Real wider = f.friction * normal;
    tangential = carried.tangential - (slip + f.nt * step_n) * f.inverse_tt;
    tangential = larger(smaller(tangential, f.bytes_left + wider), -(f.bytes_right + wider));
  } else if constexpr (law == PointFriction::fixed_direction) {
    tangential = f.bytes_left + f.friction * normal;
  }
  if constexpr (law != PointFriction::none) {
    step_t = tangential - carried.tangential;
    change_t = tangential - at.tangential;
  }

  // the shift also takes back what this time step's velocities would still add to the overlap; crushed ice is not given
  // back as motion
  const Real shift = w.shift_x * f.normal_x + w.shift_y * f.normal_y + w.turn_b * f.lever_b_n - w.turn_a * f.lever_a_n +
                     f.repair_excess;
  const Real closing = pick(normal < f.most, smaller(excess, zero), zero);
  const Real repair = larger(carried.repair - (shift + pace.dt * closing) * f.inverse_nn, f.repair_least);
  const Real step_r = repair - carried.repair, change_r = repair - at.repair;

  const Real along = zero + momentum_coefficient;
  const Real along_r = pick(opposed(step_r, change_r), zero, along);
  at = {normal, tangential, repair};
  carried = {normal + along * change_n, tangential + along * change_t, repair + along_r * change_r};
  return {step_n, step_t, step_r};
}

/// The largest speed that a point still asked for by the steps of a visit [m/s]. Two divisions, so not asked of every
/// visit.
template <PointFriction law, class Real, class Scalar>
GEM_HD GEM_INLINE Real speed_asked(const PointFrame<Real>& f, const PointImpulse<Real>& step, StepLength<Scalar> pace) {
  const Real of_normal = larger(magnitude(step.normal), magnitude(step.repair) * pace.per_step) / f.inverse_nn;
  if constexpr (law == PointFriction::none) return of_normal;
  return larger(of_normal, magnitude(step.tangential) / f.inverse_tt);
}

/// Enters what a point keeps for the whole time step.
GEM_HD inline void enter_geometry(PointFrame<float>& f, const PointGeometry<double>& g) {
  f.normal_x = static_cast<float>(g.normal_x);
  f.normal_y = static_cast<float>(g.normal_y);
  f.lever_a_n = static_cast<float>(g.lever_a_n);
  f.lever_a_t = static_cast<float>(g.lever_a_t);
  f.lever_b_n = static_cast<float>(g.lever_b_n);
  f.lever_b_t = static_cast<float>(g.lever_b_t);
  f.inverse_nn = static_cast<float>(1.0 / g.nn);
  f.inverse_tt = static_cast<float>(1.0 / g.tt);
  f.nt = static_cast<float>(g.nt);
  f.friction = static_cast<float>(g.friction);
}

/// Room for additions that nothing bounds [N s].
constexpr double boundless = 1e30;

/// Enters what the base gives: impulses `p` and the motions of both bodies under all of them.
GEM_HD inline void enter_base(PointFrame<float>& f, const PointGeometry<double>& g, const PointImpulse<double>& p,
                              const Motion<double>& a, const Motion<double>& b) {
  const double x = b.x - a.x, y = b.y - a.y;
  f.excess =
      static_cast<float>(x * g.normal_x + y * g.normal_y + b.spin * g.lever_b_n - a.spin * g.lever_a_n - g.target);
  f.slip = static_cast<float>(y * g.normal_x - x * g.normal_y + b.spin * g.lever_b_t - a.spin * g.lever_a_t);
  f.least = static_cast<float>(-p.normal);
  f.most = static_cast<float>(smaller(g.cap - p.normal, boundless));
  f.bytes_left = static_cast<float>(g.friction * p.normal - p.tangential);
  f.bytes_right = static_cast<float>(g.friction * p.normal + p.tangential);
  f.repair_excess = static_cast<float>((b.shift_x - a.shift_x) * g.normal_x + (b.shift_y - a.shift_y) * g.normal_y +
                                       b.turn * g.lever_b_n - a.turn * g.lever_a_n - g.repair_target);
  f.repair_least = static_cast<float>(-p.repair);
}

/// `p` with what was added to it, `least` and `most` being what could be: a bound that is met is met exactly.
GEM_HD inline double within_bounds(double p, float added, float least, float most, double cap) {
  if (added <= least) return 0.0;
  if (added >= most) return cap;
  return smaller(larger(p + static_cast<double>(added), 0.0), cap);
}

/// The base after the additions of a round; `least`, `most` and `repair_least` stand in the point's frame.
GEM_HD inline PointImpulse<double> with_additions(PointFriction law, const PointGeometry<double>& g,
                                                  const PointImpulse<double>& p, const PointImpulse<float>& added,
                                                  float least, float most, float repair_least) {
  const double normal = within_bounds(p.normal, added.normal, least, most, g.cap);
  const double limit = g.friction * normal, wanted = p.tangential + static_cast<double>(added.tangential);
  const double tangential = law == PointFriction::none      ? 0.0
                            : law == PointFriction::coulomb ? larger(smaller(wanted, limit), -limit)
                                                            : limit;
  const double repair = added.repair <= repair_least ? 0.0 : larger(p.repair + static_cast<double>(added.repair), 0.0);
  return {normal, tangential, repair};
}

}  // namespace gem
