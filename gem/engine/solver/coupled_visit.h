// The iterations of a coupled time step for one point.
//
// All points are visited at once from the same velocities: projected gradient in the metric of the divided masses.
// Since each body's mass is divided among its points (as Tonge et al. 2012 do), no point overshoots, whatever the
// others do. The impulses are then extrapolated along their last change (Nesterov 1983; Beck and Teboulle 2009). In a
// chain of n bodies this reduces the number of iterations from the order of n^2 to the order of n. When the residual
// has grown, the extrapolation restarts at zero (after O'Donoghue and Candes 2015; their test needs a sum over all
// points, while the residual is at hand). A repair whose step opposes its change is not extrapolated: too much repair
// would open a gap.
//
// With friction, the bound of the tangential impulse depends on the normal impulse, so the iterations minimise no fixed
// function. They are a fixed-point iteration without a proof of convergence; R1 to R3 of validation/hard judge the
// result.
//
// The iterations work on additions to a base. The base holds impulses and velocities in double precision; each point
// has the single-precision values of PointFrame. Rounding is then relative to the additions and not to the whole. At
// the end of a round the additions go into the base and the next round starts from it, so that any residual can be
// reached.
#pragma once

#include "gem/base/choose.h"
#include "gem/base/macros.h"
#include "gem/engine/solver/coupled_point.h"
#include "gem/events/friction_memory.h"

namespace gem {

/// Data of a point during a round.
template <class Real>
struct PointFrame {
  Real normal_x, normal_y;
  Real lever_a_n, lever_a_t, lever_b_n, lever_b_t;  // arm x normal, arm x tangent [m]
  Real inverse_nn, inverse_tt, nt;
  Real friction;
  // at the base
  Real excess, slip;   // u_n - target, u_t [m/s]
  Real least, most;    // bounds of the addition to P_n: -P_n and cap - P_n [N s]
  Real slack_left;     // mu P_n - P_t + spare friction [N s]
  Real slack_right;    // mu P_n + P_t + spare friction [N s]
  Real repair_excess;  // shift along the normal minus the share of the overlap to remove [m]
  Real repair_least;   // lower bound of the addition to the repair [kg m]
};

/// Motion of B relative to A. Points of the same pair differ only in their levers.
template <class Real>
struct Approach {
  Real x, y, shift_x, shift_y;
  Real spin_a, turn_a, spin_b, turn_b;
};

/// Pushes of the extrapolated impulses: the sums go to B, their opposites to A.
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

/// Length of a time step and its inverse.
template <class Scalar>
struct StepLength {
  Scalar dt;        // [s]
  Scalar per_step;  // 1 / dt [1/s]
};

/// Whether two numbers have opposite signs. A product could underflow.
template <class Real>
GEM_HD GEM_INLINE auto opposed(Real p, Real q) {
  const Real zero{};
  return ((p < zero) & (q > zero)) | ((p > zero) & (q < zero));
}

/// One visit of a point. On entry `extrapolated` holds the extrapolated additions, and `w` the motion that all points'
/// extrapolated additions give. On return `added` holds the new additions, and `extrapolated` is `added` plus
/// `momentum_coefficient` times the change of `added`. Returns the new additions minus the old extrapolated ones.
template <PointFriction law, class Real, class Scalar>
GEM_HD GEM_INLINE PointImpulse<Real> visit_point(const PointFrame<Real>& f, const Approach<Real>& w,
                                                 StepLength<Scalar> pace, Scalar momentum_coefficient,
                                                 PointImpulse<Real>& added, PointImpulse<Real>& extrapolated) {
  const Real zero{};
  const Real excess = w.x * f.normal_x + w.y * f.normal_y + w.spin_b * f.lever_b_n - w.spin_a * f.lever_a_n + f.excess;
  const Real normal = smaller(larger(extrapolated.normal - excess * f.inverse_nn, f.least), f.most);
  const Real step_n = normal - extrapolated.normal, change_n = normal - added.normal;

  Real tangential = zero, step_t = zero, change_t = zero;
  if constexpr (law == PointFriction::coulomb) {
    const Real slip = w.y * f.normal_x - w.x * f.normal_y + w.spin_b * f.lever_b_t - w.spin_a * f.lever_a_t + f.slip;
    const Real wider = f.friction * normal;
    tangential = extrapolated.tangential - (slip + f.nt * step_n) * f.inverse_tt;
    tangential = larger(smaller(tangential, f.slack_left + wider), -(f.slack_right + wider));
  } else if constexpr (law == PointFriction::fixed_direction) {
    tangential = f.slack_left + f.friction * normal;
  }
  if constexpr (law != PointFriction::none) {
    step_t = tangential - extrapolated.tangential;
    change_t = tangential - added.tangential;
  }

  // The shift also removes the overlap that the remaining closing velocity adds in this time step. At the cap it does
  // not: crushed ice is not pushed back.
  const Real shift = w.shift_x * f.normal_x + w.shift_y * f.normal_y + w.turn_b * f.lever_b_n - w.turn_a * f.lever_a_n +
                     f.repair_excess;
  const Real closing = pick(normal < f.most, smaller(excess, zero), zero);
  const Real repair = larger(extrapolated.repair - (shift + pace.dt * closing) * f.inverse_nn, f.repair_least);
  const Real step_r = repair - extrapolated.repair, change_r = repair - added.repair;

  const Real along = zero + momentum_coefficient;
  const Real along_r = pick(opposed(step_r, change_r), zero, along);
  added = {normal, tangential, repair};
  extrapolated = {normal + along * change_n, tangential + along * change_t, repair + along_r * change_r};
  return {step_n, step_t, step_r};
}

/// The largest velocity correction that a point made in a visit [m/s]. It costs two divisions, so it is not evaluated
/// in every visit.
template <PointFriction law, class Real, class Scalar>
GEM_HD GEM_INLINE Real remaining_speed(const PointFrame<Real>& f, const PointImpulse<Real>& step,
                                       StepLength<Scalar> pace) {
  const Real of_normal = larger(magnitude(step.normal), magnitude(step.repair) * pace.per_step) / f.inverse_nn;
  if constexpr (law == PointFriction::none) return of_normal;
  return larger(of_normal, magnitude(step.tangential) / f.inverse_tt);
}

/// Sets the constants of a point for the time step.
GEM_HD inline void set_geometry_values(PointFrame<float>& f, const PointGeometry<double>& g) {
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

/// Bound of an addition that has no limit [N s].
constexpr double boundless = 1e30;

/// Sets the data of a point at the base: impulses `p`, and the motions of both bodies after all base impulses.
GEM_HD inline void set_base_values(PointFrame<float>& f, const PointGeometry<double>& g, SpareFriction spare,
                                   const PointImpulse<double>& p, const Motion<double>& a, const Motion<double>& b) {
  const double x = b.x - a.x, y = b.y - a.y;
  f.excess =
      static_cast<float>(x * g.normal_x + y * g.normal_y + b.spin * g.lever_b_n - a.spin * g.lever_a_n - g.target);
  f.slip = static_cast<float>(y * g.normal_x - x * g.normal_y + b.spin * g.lever_b_t - a.spin * g.lever_a_t);
  f.least = static_cast<float>(-p.normal);
  f.most = static_cast<float>(smaller(g.cap - p.normal, boundless));
  f.slack_left = static_cast<float>(g.friction * p.normal - p.tangential + spare.left);
  f.slack_right = static_cast<float>(g.friction * p.normal + p.tangential + spare.right);
  f.repair_excess = static_cast<float>((b.shift_x - a.shift_x) * g.normal_x + (b.shift_y - a.shift_y) * g.normal_y +
                                       b.turn * g.lever_b_n - a.turn * g.lever_a_n - g.repair_target);
  f.repair_least = static_cast<float>(-p.repair);
}

/// `p` plus an addition. `least` and `most` are the bounds of the addition; where it reaches one, the result is exactly
/// 0 or `cap`.
GEM_HD inline double within_bounds(double p, float added, float least, float most, double cap) {
  if (added <= least) return 0.0;
  if (added >= most) return cap;
  return smaller(larger(p + static_cast<double>(added), 0.0), cap);
}

/// The base after the additions of a round; `least`, `most` and `repair_least` are those of the point's frame.
GEM_HD inline PointImpulse<double> with_additions(PointFriction law, const PointGeometry<double>& g,
                                                  SpareFriction spare, const PointImpulse<double>& p,
                                                  const PointImpulse<float>& added, float least, float most,
                                                  float repair_least) {
  const double normal = within_bounds(p.normal, added.normal, least, most, g.cap);
  const double limit = g.friction * normal, wanted = p.tangential + static_cast<double>(added.tangential);
  const double tangential = law == PointFriction::none ? 0.0
                            : law == PointFriction::coulomb
                                ? larger(smaller(wanted, limit + spare.left), -(limit + spare.right))
                                : limit;
  const double repair = added.repair <= repair_least ? 0.0 : larger(p.repair + static_cast<double>(added.repair), 0.0);
  return {normal, tangential, repair};
}

}  // namespace gem
