// One contact point during the iterations of operator splitting: its numbers and each of its steps, for one point or
// for several side by side.
//
// Every point keeps its impulse P and a copy z of its velocity, both along the normal and along the tangent. A visit
// takes the velocity u that the bodies have now, and sets
//
//     x = 1.6 u - 0.6 z              over-relaxed
//     P' = P - R x within the bounds of the law,  z' = x + (P' - P) / R
//
// It then asks the bodies for P + R (z - u): the step of the velocities that follows closes the gap between u and z.
// R is `stiffness` over the compliance of the point. The repair of the overlap is treated in the same way, without
// friction.
//
// Impulses and velocities are additions to a base, as in coupled_visit.h. Motions come as three numbers of each body,
// over its BodyScale.
#pragma once

#include <cstdint>

#include "gem/base/choose.h"
#include "gem/base/strict_math.h"
#include "gem/engine/solver/coupled_visit.h"

namespace gem {

/// Inverse masses of a body; zero for a fixed one.
struct InverseMass {
  double mass = 0.0;     // [1/kg]
  double inertia = 0.0;  // [1/(kg m2)]
};

/// Powers of two near the roots of the inverse masses of a body, so that all bodies have masses near one. Numbers times
/// powers of two keep their bits.
struct BodyScale {
  double mass = 0.0;     // [kg^-1/2]
  double inertia = 0.0;  // [kg^-1/2 m^-1]
};

/// Power of two near the root of x, a normal number; 0 for 0.
GEM_HD inline double near_root(double x) {
  if (!(x > 0.0)) return 0.0;
  const auto exponent = static_cast<std::int64_t>(strict::bits_of(x) >> 52) - 1022;
  return strict::power_of_two((exponent - (exponent & 1)) / 2);
}

GEM_HD inline BodyScale scale_of(InverseMass inverse) { return {near_root(inverse.mass), near_root(inverse.inertia)}; }

/// A moving body in the iterations: scaled motions to speeds (a spin at the radius of gyration), and scaled masses.
struct ScaledBody {
  float speed, spin_speed;
  float mass, inertia;
};

GEM_HD inline ScaledBody scaled_body(InverseMass inverse) {
  const BodyScale scale = scale_of(inverse);
  const bool turns = inverse.inertia > 0.0;
  return {static_cast<float>(scale.mass),
          turns ? static_cast<float>(std::sqrt(inverse.mass / inverse.inertia) * scale.inertia) : 0.0F,
          static_cast<float>(scale.mass * scale.mass / inverse.mass),
          turns ? static_cast<float>(scale.inertia * scale.inertia / inverse.inertia) : 1.0F};
}

template <class Real>
struct SplitPoint {
  Real n_a[3], n_b[3], t_a[3], t_b[3];  // Jacobian times the scales of the bodies
  Real inverse_nn, inverse_tt;          // [kg]
  Real friction;
  Real stiff_n, stiff_t, soft_n, soft_t;  // R [kg] and 1 / R
  // of PointFrame: velocities [m/s], bounds [N s]; shift [m] and bound [kg m] of the repair
  Real excess, slip, least, most, slack_left, slack_right, repair_excess, repair_least;
  Real normal, tangential, repair;    // additions to the base [N s], [kg m]
  Real gap, slide, shift, shift_t;    // copies of the velocities [m/s] and of the shift [m]
  Real answer_n, answer_t, answer_r;  // additions to the base, as the result
  // watch_point(): how much stiffer than others; the last difference; how often it persisted
  Real scale_n, scale_t, last_n, last_t, count_n, count_t;
};

/// What a point asks of its bodies: parts along its normal and along its tangent.
template <class Real>
struct PointShare {
  Real n, t;
};

/// A new velocity counts 1.6 times, the old copy -0.6 times: over-relaxation, as is usual for alternating directions.
constexpr float relaxation = 1.6F, old_part = 1.0F - relaxation;

/// The Jacobian of a point times the motions of its bodies.
template <class Real>
GEM_HD GEM_INLINE Real along(const Real* of_a, const Real* of_b, const Real* a, const Real* b) {
  return (of_a[0] * a[0] + of_a[1] * a[1] + of_a[2] * a[2]) + (of_b[0] * b[0] + of_b[1] * b[1] + of_b[2] * b[2]);
}

/// What a point asks for where its impulses and copies stay.
template <class Real>
GEM_HD GEM_INLINE PointShare<Real> push_of(const SplitPoint<Real>& q, const Real* a, const Real* b) {
  const Real n = along(q.n_a, q.n_b, a, b), t = along(q.t_a, q.t_b, a, b);
  return {q.normal + q.stiff_n * (q.gap - n), q.tangential + q.stiff_t * (q.slide - t)};
}
template <class Real>
GEM_HD GEM_INLINE PointShare<Real> repair_push_of(const SplitPoint<Real>& q, const Real* a, const Real* b) {
  const Real r = along(q.n_a, q.n_b, a, b), s = along(q.t_a, q.t_b, a, b);
  return {q.repair + q.stiff_n * (q.shift - r), q.stiff_t * (q.shift_t - s)};
}

template <PointFriction law, class Real>
GEM_HD GEM_INLINE PointShare<Real> visit_point(SplitPoint<Real>& q, const Real* a, const Real* b) {
  const Real n = along(q.n_a, q.n_b, a, b), t = along(q.t_a, q.t_b, a, b);
  const Real relaxed_n = relaxation * n + old_part * q.gap, relaxed_t = relaxation * t + old_part * q.slide;
  const Real last_n = q.normal, last_t = q.tangential;
  q.normal = smaller(larger(last_n - q.stiff_n * (q.excess + relaxed_n), q.least), q.most);
  q.gap = relaxed_n + (q.normal - last_n) * q.soft_n;
  const Real wider = q.friction * q.normal;
  if constexpr (law == PointFriction::coulomb)
    q.tangential =
        larger(smaller(last_t - q.stiff_t * (q.slip + relaxed_t), q.slack_left + wider), -(q.slack_right + wider));
  else if constexpr (law == PointFriction::fixed_direction)
    q.tangential = q.slack_left + wider;
  q.slide = relaxed_t + (q.tangential - last_t) * q.soft_t;
  return {q.normal + q.stiff_n * (q.gap - n), q.tangential + q.stiff_t * (q.slide - t)};
}
template <class Real>
GEM_HD GEM_INLINE PointShare<Real> visit_repair(SplitPoint<Real>& q, const Real* a, const Real* b) {
  const Real r = along(q.n_a, q.n_b, a, b), s = along(q.t_a, q.t_b, a, b);
  const Real relaxed_r = relaxation * r + old_part * q.shift, last_r = q.repair;
  q.repair = larger(last_r - q.stiff_n * (q.repair_excess + relaxed_r), q.repair_least);
  q.shift = relaxed_r + (q.repair - last_r) * q.soft_n;
  q.shift_t = relaxation * s + old_part * q.shift_t;
  return {q.repair + q.stiff_n * (q.shift - r), q.stiff_t * (q.shift_t - s)};
}

/// Sets the impulses that the velocities ask for, without over-relaxation. A point that sticks gets exactly what the
/// bodies have.
template <PointFriction law, class Real>
GEM_HD GEM_INLINE PointShare<Real> answer_point(SplitPoint<Real>& q, const Real* a, const Real* b) {
  const Real n = q.excess + along(q.n_a, q.n_b, a, b), t = q.slip + along(q.t_a, q.t_b, a, b);
  q.answer_n = smaller(larger(q.normal - q.stiff_n * n, q.least), q.most);
  const Real wider = q.friction * q.answer_n;
  if constexpr (law == PointFriction::coulomb)
    q.answer_t = larger(smaller(q.tangential - q.stiff_t * t, q.slack_left + wider), -(q.slack_right + wider));
  else if constexpr (law == PointFriction::fixed_direction)
    q.answer_t = q.slack_left + wider;
  return {q.answer_n, q.answer_t};
}
template <class Real>
GEM_HD GEM_INLINE PointShare<Real> answer_repair(SplitPoint<Real>& q, const Real* a, const Real* b) {
  const Real r = q.repair_excess + along(q.n_a, q.n_b, a, b);
  q.answer_r = larger(q.repair - q.stiff_n * r, q.repair_least);
  return {q.answer_r, Real{}};
}

/// Difference between the velocities of a point and their copies [m/s], and the same of the repair [m].
template <class Real>
GEM_HD GEM_INLINE Real mismatch_of(const SplitPoint<Real>& q, const Real* a, const Real* b) {
  const Real n = along(q.n_a, q.n_b, a, b) - q.gap, t = along(q.t_a, q.t_b, a, b) - q.slide;
  return larger(magnitude(n), magnitude(t));
}
template <class Real>
GEM_HD GEM_INLINE Real repair_mismatch_of(const SplitPoint<Real>& q, const Real* a, const Real* b) {
  const Real r = along(q.n_a, q.n_b, a, b) - q.shift, s = along(q.t_a, q.t_b, a, b) - q.shift_t;
  return larger(magnitude(r), magnitude(s));
}

template <class Real>
GEM_HD GEM_INLINE void watch_one(Real difference, Real& last, Real& times, float tolerance) {
  constexpr float persists = 0.5F;
  const Real zero{}, one = zero + 1.0F;
  const auto same = ((difference > zero) & (last > zero)) | ((difference < zero) & (last < zero));
  const auto large = (magnitude(difference) > persists * magnitude(last)) & (magnitude(difference) > zero + tolerance);
  times = pick(same & large, times + one, zero);
  last = difference;
}
/// Counts how often in a row the velocity and the copy differed in the same direction, by more than `tolerance` [m/s]
/// and by more than half of the last difference. Repairs are left out.
template <class Real>
GEM_HD GEM_INLINE void watch_point(SplitPoint<Real>& q, const Real* a, const Real* b, float tolerance) {
  watch_one(along(q.n_a, q.n_b, a, b) - q.gap, q.last_n, q.count_n, tolerance);
  watch_one(along(q.t_a, q.t_b, a, b) - q.slide, q.last_t, q.count_t, tolerance);
}

template <class Real>
GEM_HD GEM_INLINE Real raise_one(Real& scale, Real& times) {
  constexpr float often = 2.0F, stiffer = 4.0F, most = 256.0F;  // chosen by hand
  const Real zero{};
  const Real next = pick((times >= zero + often) & (scale < zero + most), stiffer * scale, scale);
  const Real rise = next - scale;
  times = pick(next > scale, zero, times);
  scale = next;
  return rise;
}
/// Makes a point stiffer whose difference persisted twice. Returns more than zero if it did.
template <class Real>
GEM_HD GEM_INLINE Real raise_point(SplitPoint<Real>& q) {
  const Real n = raise_one(q.scale_n, q.count_n), t = raise_one(q.scale_t, q.count_t);
  return larger(n, t);
}

/// Sets R. `raised`: whether a point that raise_point() found is stiffer.
template <class Real>
GEM_HD GEM_INLINE void stiffen_point(SplitPoint<Real>& q, float stiffness, bool raised) {
  const Real zero{}, one = zero + 1.0F;
  q.stiff_n = stiffness * q.inverse_nn * (raised ? q.scale_n : one);
  q.stiff_t = stiffness * q.inverse_tt * (raised ? q.scale_t : one);
  q.soft_n = pick(q.stiff_n > zero, one / q.stiff_n, zero);
  q.soft_t = pick(q.stiff_t > zero, one / q.stiff_t, zero);
}

/// Number `lane` of a pack; the number itself where Real is float.
template <class Real>
GEM_HD GEM_INLINE float& lane_of(Real& numbers, int lane) {
  return reinterpret_cast<float*>(&numbers)[lane];
}
template <class Real>
GEM_HD GEM_INLINE float lane_of(const Real& numbers, int lane) {
  return reinterpret_cast<const float*>(&numbers)[lane];
}

/// Impulse for a speed of a point along its normal and along its tangent [kg], with the whole mass of each body, while
/// g.nn and g.tt divide it among the points.
struct PointInertia {
  float normal, tangential;
};

GEM_HD inline PointInertia inertia_of(const PointGeometry<double>& g, InverseMass of_a, InverseMass of_b) {
  const double mass = of_a.mass + of_b.mass;
  return {static_cast<float>(
              1.0 / (mass + of_a.inertia * g.lever_a_n * g.lever_a_n + of_b.inertia * g.lever_b_n * g.lever_b_n)),
          static_cast<float>(
              1.0 / (mass + of_a.inertia * g.lever_a_t * g.lever_a_t + of_b.inertia * g.lever_b_t * g.lever_b_t))};
}

/// Sets the Jacobian of a point times the scales of its bodies. Zero masses for a fixed body.
template <class Point>
GEM_HD inline void set_jacobian(Point& q, int lane, const PointGeometry<double>& g, InverseMass of_a,
                                InverseMass of_b) {
  const auto set_side = [&](InverseMass m, double sign, double lever_n, double lever_t, auto* n, auto* t) {
    const BodyScale scale = scale_of(m);
    const double by_mass = sign * scale.mass, by_inertia = sign * scale.inertia;
    lane_of(n[0], lane) = static_cast<float>(by_mass * g.normal_x);
    lane_of(n[1], lane) = static_cast<float>(by_mass * g.normal_y);
    lane_of(n[2], lane) = static_cast<float>(by_inertia * lever_n);
    lane_of(t[0], lane) = static_cast<float>(-by_mass * g.normal_y);
    lane_of(t[1], lane) = static_cast<float>(by_mass * g.normal_x);
    lane_of(t[2], lane) = static_cast<float>(by_inertia * lever_t);
  };
  set_side(of_a, -1.0, g.lever_a_n, g.lever_a_t, q.n_a, q.t_a);
  set_side(of_b, 1.0, g.lever_b_n, g.lever_b_t, q.n_b, q.t_b);
}

/// Sets the bounds of the additions of a point to those of its frame.
template <class Point>
GEM_HD inline void set_bounds(Point& q, int lane, const PointFrame<float>& frame) {
  lane_of(q.excess, lane) = frame.excess;
  lane_of(q.slip, lane) = frame.slip;
  lane_of(q.least, lane) = frame.least;
  lane_of(q.most, lane) = frame.most;
  lane_of(q.slack_left, lane) = frame.slack_left;
  lane_of(q.slack_right, lane) = frame.slack_right;
  lane_of(q.repair_excess, lane) = frame.repair_excess;
  lane_of(q.repair_least, lane) = frame.repair_least;
}

/// Sets the constants of a point. Zero masses for a fixed body.
template <class Real>
GEM_HD inline void set_point(SplitPoint<Real>& q, int lane, const PointGeometry<double>& g, InverseMass of_a,
                             InverseMass of_b) {
  set_jacobian(q, lane, g, of_a, of_b);
  const PointInertia inertia = inertia_of(g, of_a, of_b);
  lane_of(q.inverse_nn, lane) = inertia.normal;
  lane_of(q.inverse_tt, lane) = inertia.tangential;
  lane_of(q.friction, lane) = static_cast<float>(g.friction);
  lane_of(q.scale_n, lane) = lane_of(q.scale_t, lane) = 1.0F;
  lane_of(q.answer_n, lane) = lane_of(q.answer_t, lane) = lane_of(q.answer_r, lane) = 0.0F;
}

/// Begins a round: sets the bounds of the additions, and copies of the velocities that obey the law of friction and
/// contact with the impulses of the base (not the law of crushing: the first visit takes care of that). `a`, `b`:
/// motions that the base gives.
template <class Real>
GEM_HD inline void set_base(SplitPoint<Real>& q, int lane, PointFriction law, const PointGeometry<double>& g,
                            SpareFriction spare, const PointImpulse<double>& impulse, const Motion<double>& a,
                            const Motion<double>& b) {
  PointFrame<float> frame;
  set_base_values(frame, g, spare, impulse, a, b);
  set_bounds(q, lane, frame);
  lane_of(q.gap, lane) = (impulse.normal > 0.0 ? 0.0F : larger(frame.excess, 0.0F)) - frame.excess;
  // at the bound of friction but for rounding
  const float nearest = smaller(frame.slack_left, frame.slack_right);
  const bool at_bound = nearest <= 1e-6F * (frame.slack_left + frame.slack_right);
  const bool slides =
      law != PointFriction::coulomb || impulse.normal <= 0.0 || (at_bound && frame.slip * impulse.tangential <= 0.0);
  lane_of(q.slide, lane) = slides ? 0.0F : -frame.slip;
  lane_of(q.shift, lane) = (impulse.repair > 0.0 ? 0.0F : larger(frame.repair_excess, 0.0F)) - frame.repair_excess;
  lane_of(q.normal, lane) = lane_of(q.tangential, lane) = lane_of(q.repair, lane) = lane_of(q.shift_t, lane) = 0.0F;
  lane_of(q.last_n, lane) = lane_of(q.last_t, lane) = lane_of(q.count_n, lane) = lane_of(q.count_t, lane) = 0.0F;
}

/// Whether a point repairs an overlap.
GEM_HD inline bool repairs(const PointGeometry<double>& g, const PointImpulse<double>& impulse) {
  return g.repair_target > 0.0 || impulse.repair > 0.0;
}

/// `speed`, or the largest number if `x` is not a finite number: bounds hide such a number from what is measured after
/// them.
template <class Real>
GEM_HD GEM_INLINE Real unless_finite(Real x, Real speed) {
  constexpr float largest_float = 3.402823466e38F;
  return pick(magnitude(x) <= Real{} + largest_float, speed, Real{} + largest_float);
}

/// Largest speed that a point would change if it alone answered the motions `a` and `b` of the base [m/s]. A shift of
/// the repair counts `per_step` times [1/s].
GEM_HD inline float speed_asked_at_base(PointFriction law, const PointGeometry<double>& g, PointInertia inertia,
                                        SpareFriction spare, const PointImpulse<double>& impulse,
                                        const Motion<double>& a, const Motion<double>& b, float per_step) {
  PointFrame<float> f;
  set_base_values(f, g, spare, impulse, a, b);
  const float normal = smaller(larger(-f.excess * inertia.normal, f.least), f.most);
  const float repair = larger(-f.repair_excess * inertia.normal, f.repair_least);
  const float wider = static_cast<float>(g.friction) * normal;
  float tangential = 0.0F;
  if (law == PointFriction::coulomb)
    tangential = larger(smaller(-f.slip * inertia.tangential, f.slack_left + wider), -(f.slack_right + wider));
  if (law == PointFriction::fixed_direction) tangential = f.slack_left + wider;
  const float asked = larger(larger(magnitude(normal), per_step * magnitude(repair)) / inertia.normal,
                             magnitude(tangential) / inertia.tangential);
  return unless_finite(f.excess + f.slip + f.repair_excess, asked);
}

/// The impulse of a point with its last answer.
template <class Point>
GEM_HD inline PointImpulse<double> with_answer(const Point& q, int lane, PointFriction law,
                                               const PointGeometry<double>& g, SpareFriction spare,
                                               const PointImpulse<double>& impulse) {
  return with_additions(law, g, spare, impulse,
                        {lane_of(q.answer_n, lane), lane_of(q.answer_t, lane), lane_of(q.answer_r, lane)},
                        lane_of(q.least, lane), lane_of(q.most, lane), lane_of(q.repair_least, lane));
}

}  // namespace gem
