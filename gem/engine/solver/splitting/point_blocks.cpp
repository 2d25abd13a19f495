#include "gem/engine/solver/splitting/point_blocks.h"

#include <cmath>

#include "gem/base/choose.h"
#include "gem/engine/solver/coupled_visit.h"

namespace gem {
namespace {

constexpr float relaxation = 1.6F, kept = 1.0F - relaxation;

/// The half rows of eight bodies, by component.
template <int half>
GEM_INLINE void load_motions(const std::vector<BodyRow>& rows, const std::int32_t* place, FloatPack* motion) {
  const auto at = [&](int k) { return reinterpret_cast<const float*>(&rows[place[k]]) + 4 * half; };
  for (int k = 0; k < 4; ++k) motion[k] = side_by_side(at(k), at(k + 4));
  transpose_halves(motion);
}

/// Adds the pushes of eight points, given by component, to the half rows of their bodies, in the order of the points.
template <int half>
GEM_INLINE void add_pushes(std::vector<BodyRow>& rows, const std::int32_t* place, FloatPack* push) {
  transpose_halves(push);
  for (int k = 0; k < float_lanes; ++k) {
    float* const to = reinterpret_cast<float*>(&rows[place[k]]) + 4 * half;
    FloatHalf part, sum;
    __builtin_memcpy(&part, reinterpret_cast<const float*>(&push[k % 4]) + 4 * (k / 4), sizeof part);
    __builtin_memcpy(&sum, to, sizeof sum);
    sum += part;
    __builtin_memcpy(to, &sum, sizeof sum);
  }
}

/// The Jacobian of eight points times the motions of their bodies.
GEM_INLINE FloatPack along(const FloatPack* of_a, const FloatPack* of_b, const FloatPack* a, const FloatPack* b) {
  return (of_a[0] * a[0] + of_a[1] * a[1] + of_a[2] * a[2]) + (of_b[0] * b[0] + of_b[1] * b[1] + of_b[2] * b[2]);
}

}  // namespace

BodyScale scale_of(InverseMass inverse) {
  const auto near_root = [](double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return x > 0.0 ? std::ldexp(1.0, (exponent - (exponent & 1)) / 2) : 0.0;
  };
  return {near_root(inverse.mass), near_root(inverse.inertia)};
}

void PointBlocks::resize(std::int32_t points) {
  block_.assign((points + float_lanes - 1) / float_lanes, Block{});
  for (Block& q : block_) q.scale_n = q.scale_t = FloatPack{} + 1.0F;
  repairs_ = false;
}

void PointBlocks::set_point(std::int32_t k, const PointGeometry<double>& g, std::int32_t a, std::int32_t b,
                            InverseMass of_a, InverseMass of_b, std::int32_t pair) {
  Block& q = block_[k / float_lanes];
  const std::int32_t lane = k % float_lanes;
  q.a[lane] = a;
  q.b[lane] = b;
  q.pair[lane] = pair;
  const auto set_side = [&](InverseMass m, double sign, double lever_n, double lever_t, FloatPack* n, FloatPack* t) {
    const BodyScale scale = scale_of(m);
    const double by_mass = sign * scale.mass, by_inertia = sign * scale.inertia;
    n[0][lane] = static_cast<float>(by_mass * g.normal_x);
    n[1][lane] = static_cast<float>(by_mass * g.normal_y);
    n[2][lane] = static_cast<float>(by_inertia * lever_n);
    t[0][lane] = static_cast<float>(-by_mass * g.normal_y);
    t[1][lane] = static_cast<float>(by_mass * g.normal_x);
    t[2][lane] = static_cast<float>(by_inertia * lever_t);
  };
  set_side(of_a, -1.0, g.lever_a_n, g.lever_a_t, q.n_a, q.t_a);
  set_side(of_b, 1.0, g.lever_b_n, g.lever_b_t, q.n_b, q.t_b);
  // with the whole mass of each body, while g.nn and g.tt divide it among the points
  const double mass = of_a.mass + of_b.mass;
  q.inverse_nn[lane] = static_cast<float>(
      1.0 / (mass + of_a.inertia * g.lever_a_n * g.lever_a_n + of_b.inertia * g.lever_b_n * g.lever_b_n));
  q.inverse_tt[lane] = static_cast<float>(
      1.0 / (mass + of_a.inertia * g.lever_a_t * g.lever_a_t + of_b.inertia * g.lever_b_t * g.lever_b_t));
  q.friction[lane] = static_cast<float>(g.friction);
}

void PointBlocks::set_base(PointFriction law, std::int32_t k, const PointGeometry<double>& g, SpareFriction spare,
                           const PointImpulse<double>& impulse, const Motion<double>& a, const Motion<double>& b) {
  Block& q = block_[k / float_lanes];
  const std::int32_t lane = k % float_lanes;
  PointFrame<float> frame;
  set_base_values(frame, g, spare, impulse, a, b);
  q.excess[lane] = frame.excess;
  q.slip[lane] = frame.slip;
  q.least[lane] = frame.least;
  q.most[lane] = frame.most;
  q.slack_left[lane] = frame.slack_left;
  q.slack_right[lane] = frame.slack_right;
  q.repair_excess[lane] = frame.repair_excess;
  q.repair_least[lane] = frame.repair_least;
  q.gap[lane] = (impulse.normal > 0.0 ? 0.0F : larger(frame.excess, 0.0F)) - frame.excess;
  // at the bound of friction but for rounding
  const float nearest = smaller(frame.slack_left, frame.slack_right);
  const bool at_bound = nearest <= 1e-6F * (frame.slack_left + frame.slack_right);
  const bool slides =
      law != PointFriction::coulomb || impulse.normal <= 0.0 || (at_bound && frame.slip * impulse.tangential <= 0.0);
  q.slide[lane] = slides ? 0.0F : -frame.slip;
  q.shift[lane] = (impulse.repair > 0.0 ? 0.0F : larger(frame.repair_excess, 0.0F)) - frame.repair_excess;
  q.normal[lane] = q.tangential[lane] = q.repair[lane] = q.shift_t[lane] = 0.0F;
  q.last_n[lane] = q.last_t[lane] = q.count_n[lane] = q.count_t[lane] = 0.0F;
  repairs_ = repairs_ || g.repair_target > 0.0 || impulse.repair > 0.0;
}

void PointBlocks::stiffen(float stiffness, bool raised, FrontFactor& factor) {
  const FloatPack zero{}, one = zero + 1.0F;
  for (Block& q : block_) {
    q.stiff_n = stiffness * q.inverse_nn * (raised ? q.scale_n : one);
    q.stiff_t = stiffness * q.inverse_tt * (raised ? q.scale_t : one);
    q.soft_n = q.stiff_n > zero ? one / q.stiff_n : zero;
    q.soft_t = q.stiff_t > zero ? one / q.stiff_t : zero;
    for (int lane = 0; lane < float_lanes; ++lane) {
      const std::int32_t a = q.a[lane], b = q.b[lane];
      const auto add_block = [&](float* to, const FloatPack* n, const FloatPack* t, const FloatPack* m,
                                 const FloatPack* u) {
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            to[3 * r + c] += q.stiff_n[lane] * n[r][lane] * m[c][lane] + q.stiff_t[lane] * t[r][lane] * u[c][lane];
      };
      if (a != 0) add_block(factor.diagonal(a - 1), q.n_a, q.t_a, q.n_a, q.t_a);
      if (b != 0) add_block(factor.diagonal(b - 1), q.n_b, q.t_b, q.n_b, q.t_b);
      if (a > b && b != 0) add_block(factor.below(q.pair[lane]), q.n_a, q.t_a, q.n_b, q.t_b);
      if (b > a && a != 0) add_block(factor.below(q.pair[lane]), q.n_b, q.t_b, q.n_a, q.t_a);
    }
  }
}

/// Pushes of eight points with normal part `n` and tangential part `t` on both bodies. The points of a body as B come
/// before its points as A, as in the order of the points.
template <int half>
GEM_INLINE void PointBlocks::push_bodies(const Block& q, std::vector<BodyRow>& to, FloatPack n, FloatPack t) {
  FloatPack push[4];
  for (int c = 0; c < 3; ++c) push[c] = q.n_b[c] * n + q.t_b[c] * t;
  push[3] = FloatPack{};
  add_pushes<half>(to, q.b, push);
  for (int c = 0; c < 3; ++c) push[c] = q.n_a[c] * n + q.t_a[c] * t;
  push[3] = FloatPack{};
  add_pushes<half>(to, q.a, push);
}

template <bool repairs>
GEM_INLINE void PointBlocks::push_blocks(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) const {
  for (const Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(now, q.a, a);
    load_motions<0>(now, q.b, b);
    const FloatPack n = along(q.n_a, q.n_b, a, b), t = along(q.t_a, q.t_b, a, b);
    push_bodies<0>(q, sum, q.normal + q.stiff_n * (q.gap - n), q.tangential + q.stiff_t * (q.slide - t));
    if constexpr (repairs) {
      load_motions<1>(now, q.a, a);
      load_motions<1>(now, q.b, b);
      const FloatPack r = along(q.n_a, q.n_b, a, b), s = along(q.t_a, q.t_b, a, b);
      push_bodies<1>(q, sum, q.repair + q.stiff_n * (q.shift - r), q.stiff_t * (q.shift_t - s));
    }
  }
}

template <PointFriction law, bool repairs>
GEM_INLINE void PointBlocks::visit_blocks(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) {
  for (Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(now, q.a, a);
    load_motions<0>(now, q.b, b);
    const FloatPack n = along(q.n_a, q.n_b, a, b), t = along(q.t_a, q.t_b, a, b);
    const FloatPack relaxed_n = relaxation * n + kept * q.gap, relaxed_t = relaxation * t + kept * q.slide;
    const FloatPack last_n = q.normal, last_t = q.tangential;
    q.normal = smaller(larger(last_n - q.stiff_n * (q.excess + relaxed_n), q.least), q.most);
    q.gap = relaxed_n + (q.normal - last_n) * q.soft_n;
    const FloatPack wider = q.friction * q.normal;
    if constexpr (law == PointFriction::coulomb)
      q.tangential =
          larger(smaller(last_t - q.stiff_t * (q.slip + relaxed_t), q.slack_left + wider), -(q.slack_right + wider));
    else if constexpr (law == PointFriction::fixed_direction)
      q.tangential = q.slack_left + wider;
    q.slide = relaxed_t + (q.tangential - last_t) * q.soft_t;
    push_bodies<0>(q, sum, q.normal + q.stiff_n * (q.gap - n), q.tangential + q.stiff_t * (q.slide - t));
    if constexpr (repairs) {
      load_motions<1>(now, q.a, a);
      load_motions<1>(now, q.b, b);
      const FloatPack r = along(q.n_a, q.n_b, a, b), s = along(q.t_a, q.t_b, a, b);
      const FloatPack relaxed_r = relaxation * r + kept * q.shift, last_r = q.repair;
      q.repair = larger(last_r - q.stiff_n * (q.repair_excess + relaxed_r), q.repair_least);
      q.shift = relaxed_r + (q.repair - last_r) * q.soft_n;
      q.shift_t = relaxation * s + kept * q.shift_t;
      push_bodies<1>(q, sum, q.repair + q.stiff_n * (q.shift - r), q.stiff_t * (q.shift_t - s));
    }
  }
}

GEM_CLONES void PointBlocks::push(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) const {
  repairs_ ? push_blocks<true>(now, sum) : push_blocks<false>(now, sum);
}

template <PointFriction law>
GEM_INLINE void PointBlocks::visit_law(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) {
  repairs_ ? visit_blocks<law, true>(now, sum) : visit_blocks<law, false>(now, sum);
}

GEM_CLONES void PointBlocks::visit_frictionless(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) {
  visit_law<PointFriction::none>(now, sum);
}
GEM_CLONES void PointBlocks::visit_coulomb(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) {
  visit_law<PointFriction::coulomb>(now, sum);
}
GEM_CLONES void PointBlocks::visit_fixed_direction(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) {
  visit_law<PointFriction::fixed_direction>(now, sum);
}

void PointBlocks::visit(PointFriction law, const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) {
  if (law == PointFriction::none) visit_frictionless(now, sum);
  if (law == PointFriction::coulomb) visit_coulomb(now, sum);
  if (law == PointFriction::fixed_direction) visit_fixed_direction(now, sum);
}

template <PointFriction law, bool repairs>
GEM_INLINE void PointBlocks::answer_blocks(const std::vector<BodyRow>& now, std::vector<BodyRow>& given) {
  for (Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(now, q.a, a);
    load_motions<0>(now, q.b, b);
    const FloatPack n = q.excess + along(q.n_a, q.n_b, a, b), t = q.slip + along(q.t_a, q.t_b, a, b);
    q.answer_n = smaller(larger(q.normal - q.stiff_n * n, q.least), q.most);
    const FloatPack wider = q.friction * q.answer_n;
    if constexpr (law == PointFriction::coulomb)
      q.answer_t = larger(smaller(q.tangential - q.stiff_t * t, q.slack_left + wider), -(q.slack_right + wider));
    else if constexpr (law == PointFriction::fixed_direction)
      q.answer_t = q.slack_left + wider;
    push_bodies<0>(q, given, q.answer_n, q.answer_t);
    if constexpr (repairs) {
      load_motions<1>(now, q.a, a);
      load_motions<1>(now, q.b, b);
      const FloatPack r = q.repair_excess + along(q.n_a, q.n_b, a, b);
      q.answer_r = larger(q.repair - q.stiff_n * r, q.repair_least);
      push_bodies<1>(q, given, q.answer_r, FloatPack{});
    }
  }
}

template <PointFriction law>
GEM_INLINE void PointBlocks::answer_law(const std::vector<BodyRow>& now, std::vector<BodyRow>& given) {
  repairs_ ? answer_blocks<law, true>(now, given) : answer_blocks<law, false>(now, given);
}

GEM_CLONES void PointBlocks::answer(PointFriction law, const std::vector<BodyRow>& now, std::vector<BodyRow>& given) {
  if (law == PointFriction::none) answer_law<PointFriction::none>(now, given);
  if (law == PointFriction::coulomb) answer_law<PointFriction::coulomb>(now, given);
  if (law == PointFriction::fixed_direction) answer_law<PointFriction::fixed_direction>(now, given);
}

GEM_CLONES void PointBlocks::watch(const std::vector<BodyRow>& now, float tolerance) {
  constexpr float persists = 0.5F;
  const FloatPack zero{}, one = zero + 1.0F;
  const auto count = [&](FloatPack difference, FloatPack& last, FloatPack& times) {
    const auto same = ((difference > zero) & (last > zero)) | ((difference < zero) & (last < zero));
    const auto large =
        (magnitude(difference) > persists * magnitude(last)) & (magnitude(difference) > zero + tolerance);
    times = same & large ? times + one : zero;
    last = difference;
  };
  for (Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(now, q.a, a);
    load_motions<0>(now, q.b, b);
    count(along(q.n_a, q.n_b, a, b) - q.gap, q.last_n, q.count_n);
    count(along(q.t_a, q.t_b, a, b) - q.slide, q.last_t, q.count_t);
  }
}

bool PointBlocks::raise() {
  constexpr float often = 2.0F, stiffer = 4.0F, most = 256.0F;  // chosen by hand
  const FloatPack zero{};
  FloatPack any{};
  const auto raised = [&](FloatPack& scale, FloatPack& times) {
    const FloatPack next = (times >= zero + often) & (scale < zero + most) ? stiffer * scale : scale;
    times = next > scale ? zero : times;
    any = larger(any, next - scale);
    scale = next;
  };
  for (Block& q : block_) {
    raised(q.scale_n, q.count_n);
    raised(q.scale_t, q.count_t);
  }
  float most_raised = 0.0F;
  for (int lane = 0; lane < float_lanes; ++lane) most_raised = larger(most_raised, any[lane]);
  return most_raised > 0.0F;
}

GEM_CLONES float PointBlocks::mismatch(const std::vector<BodyRow>& now, float per_step) const {
  FloatPack worst{};
  for (const Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(now, q.a, a);
    load_motions<0>(now, q.b, b);
    const FloatPack n = along(q.n_a, q.n_b, a, b) - q.gap, t = along(q.t_a, q.t_b, a, b) - q.slide;
    worst = larger(worst, larger(magnitude(n), magnitude(t)));
    if (!repairs_) continue;
    load_motions<1>(now, q.a, a);
    load_motions<1>(now, q.b, b);
    const FloatPack r = along(q.n_a, q.n_b, a, b) - q.shift;
    const FloatPack s = along(q.t_a, q.t_b, a, b) - q.shift_t;
    worst = larger(worst, per_step * larger(magnitude(r), magnitude(s)));
  }
  float all = 0.0F;
  for (int lane = 0; lane < float_lanes; ++lane) all = larger(all, worst[lane]);
  return all;
}

void PointBlocks::add_to(PointFriction law, std::int32_t k, const PointGeometry<double>& g, SpareFriction spare,
                         PointImpulse<double>& impulse) const {
  const Block& q = block_[k / float_lanes];
  const std::int32_t lane = k % float_lanes;
  impulse = with_additions(law, g, spare, impulse, {q.answer_n[lane], q.answer_t[lane], q.answer_r[lane]},
                           q.least[lane], q.most[lane], q.repair_least[lane]);
}

}  // namespace gem
