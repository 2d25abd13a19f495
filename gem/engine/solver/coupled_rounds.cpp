#include "gem/engine/solver/coupled_rounds.h"

#include <algorithm>

namespace gem {

void CoupledRounds::resize(const CoupledLayout& layout) {
  const std::int32_t blocks = layout.blocks();
  block_.resize(blocks);
  addition_.assign(blocks, BlockAddition{});
  push_.resize(static_cast<std::size_t>(blocks) * float_lanes + 1);
  motion_.resize(1 + layout.bodies());
  answer_.resize(1 + layout.bodies());
  motion_[CoupledLayout::at_rest].lanes = FloatPack{};
  PointGeometry<double> unused{};
  unused.nn = unused.tt = 1.0;
  for (std::int32_t point = layout.points(); point < blocks * float_lanes; ++point) {
    set_geometry(point, unused, CoupledLayout::at_rest, CoupledLayout::at_rest);
    set_base(point, unused, {}, {}, {}, {});
  }
}

void CoupledRounds::set_geometry(std::int32_t point, const PointGeometry<double>& g, std::int32_t entry_a,
                                 std::int32_t entry_b) {
  PointFrame<float> f;
  set_geometry_values(f, g);
  Block& b = block_[point / float_lanes];
  const int lane = point % float_lanes;
  b.normal_x[lane] = f.normal_x, b.normal_y[lane] = f.normal_y;
  b.lever_a_n[lane] = f.lever_a_n, b.lever_a_t[lane] = f.lever_a_t;
  b.lever_b_n[lane] = f.lever_b_n, b.lever_b_t[lane] = f.lever_b_t;
  b.inverse_nn[lane] = f.inverse_nn, b.inverse_tt[lane] = f.inverse_tt;
  b.nt[lane] = f.nt, b.friction[lane] = f.friction;
  b.a[lane] = float_lanes * entry_a;
  b.b[lane] = float_lanes * entry_b;
}

void CoupledRounds::set_base(std::int32_t point, const PointGeometry<double>& g, SpareFriction spare,
                             const PointImpulse<double>& base, const Motion<double>& motion_a,
                             const Motion<double>& motion_b) {
  PointFrame<float> f;
  set_base_values(f, g, spare, base, motion_a, motion_b);
  Block& b = block_[point / float_lanes];
  const int lane = point % float_lanes;
  b.excess[lane] = f.excess, b.slip[lane] = f.slip;
  b.least[lane] = f.least, b.most[lane] = f.most;
  b.slack_left[lane] = f.slack_left, b.slack_right[lane] = f.slack_right;
  b.repair_excess[lane] = f.repair_excess, b.repair_least[lane] = f.repair_least;
  PointImpulse<FloatPack>&added = addition_[point / float_lanes].added,
  &extrapolated = addition_[point / float_lanes].extrapolated;
  extrapolated.normal[lane] -= added.normal[lane];
  extrapolated.tangential[lane] -= added.tangential[lane];
  extrapolated.repair[lane] -= added.repair[lane];
  added.normal[lane] = added.tangential[lane] = added.repair[lane] = 0.0F;
}

void CoupledRounds::set_body(std::int32_t entry, double inverse_mass, double inverse_inertia) {
  const auto m = static_cast<float>(inverse_mass), j = static_cast<float>(inverse_inertia);
  answer_[entry].lanes = FloatPack{m, m, m, m, j, j, j, j};
  motion_[entry].lanes = FloatPack{};
}

PointImpulse<double> CoupledRounds::with_additions(PointFriction law, std::int32_t point,
                                                   const PointGeometry<double>& g, SpareFriction spare,
                                                   const PointImpulse<double>& base) const {
  const Block& b = block_[point / float_lanes];
  const PointImpulse<FloatPack>& added = addition_[point / float_lanes].added;
  const int lane = point % float_lanes;
  return gem::with_additions(law, g, spare, base, {added.normal[lane], added.tangential[lane], added.repair[lane]},
                             b.least[lane], b.most[lane], b.repair_least[lane]);
}

GEM_INLINE PointFrame<FloatPack> CoupledRounds::frame_of(const Block& b) {
  return {b.normal_x,   b.normal_y,   b.lever_a_n,  b.lever_a_t,   b.lever_b_n,     b.lever_b_t,
          b.inverse_nn, b.inverse_tt, b.nt,         b.friction,    b.excess,        b.slip,
          b.least,      b.most,       b.slack_left, b.slack_right, b.repair_excess, b.repair_least};
}

GEM_INLINE Approach<FloatPack> CoupledRounds::approach_of(const Block& b) const {
  constexpr int half = float_lanes / 2;
  const float* const motion = reinterpret_cast<const float*>(motion_.data());
  FloatPack apart[half], turns[half];  // velocity and shift of B relative to A; spin and turn of A, then of B
  for (int lane = 0; lane < half; ++lane) {
    const float *a = motion + b.a[lane], *other_a = motion + b.a[lane + half];
    const float *to = motion + b.b[lane], *other_to = motion + b.b[lane + half];
    apart[lane] = side_by_side(to, other_to) - side_by_side(a, other_a);
    turns[lane] = __builtin_shufflevector(side_by_side(a + half, other_a + half),
                                          side_by_side(to + half, other_to + half), 0, 1, 10, 11, 4, 5, 14, 15);
  }
  transpose_halves(apart);
  transpose_halves(turns);
  return {apart[0], apart[1], apart[2], apart[3], turns[0], turns[1], turns[2], turns[3]};
}

GEM_INLINE void CoupledRounds::write_push(std::int32_t block) {
  constexpr int half = float_lanes / 2;
  const PointPush<FloatPack> push = push_of(frame_of(block_[block]), addition_[block].extrapolated);
  FloatPack w[float_lanes] = {push.x,       push.y,      push.shift_x, push.shift_y,
                              push.twist_a, push.turn_a, push.twist_b, push.turn_b};
  transpose_halves(w);
  transpose_halves(w + half);
  for (int lane = 0; lane < half; ++lane) {
    push_[float_lanes * block + lane].lanes =
        __builtin_shufflevector(w[lane], w[lane + half], 0, 1, 2, 3, 8, 9, 10, 11);
    push_[float_lanes * block + lane + half].lanes =
        __builtin_shufflevector(w[lane], w[lane + half], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

template <PointFriction law, bool judged>
GEM_INLINE float CoupledRounds::visit_range(std::int32_t begin, std::int32_t end, StepLength<float> pace,
                                            float momentum_coefficient) {
  if (begin == end) return 0.0F;
  FloatPack most{};
  Approach<FloatPack> next = approach_of(block_[begin]);
  for (std::int32_t i = begin; i < end; ++i) {
    // software pipeline over three blocks: the dependency chain of one block is longer than the CPU's reorder window
    const Approach<FloatPack> approach = next;
    if (i + 1 < end) next = approach_of(block_[i + 1]);
    BlockAddition& addition = addition_[i];
    const PointFrame<FloatPack> frame = frame_of(block_[i]);
    const PointImpulse<FloatPack> step =
        visit_point<law>(frame, approach, pace, momentum_coefficient, addition.added, addition.extrapolated);
    if constexpr (judged) most = larger(remaining_speed<law>(frame, step, pace), most);
    if (i > begin) write_push(i - 1);
  }
  write_push(end - 1);
  float largest = 0.0F;
  for (int lane = 0; lane < float_lanes; ++lane) largest = larger(most[lane], largest);
  return largest;
}

GEM_CLONES float CoupledRounds::visit_frictionless(bool judged, std::int32_t begin, std::int32_t end,
                                                   StepLength<float> pace, float momentum_coefficient) {
  return judged ? visit_range<PointFriction::none, true>(begin, end, pace, momentum_coefficient)
                : visit_range<PointFriction::none, false>(begin, end, pace, momentum_coefficient);
}

GEM_CLONES float CoupledRounds::visit_coulomb(bool judged, std::int32_t begin, std::int32_t end, StepLength<float> pace,
                                              float momentum_coefficient) {
  return judged ? visit_range<PointFriction::coulomb, true>(begin, end, pace, momentum_coefficient)
                : visit_range<PointFriction::coulomb, false>(begin, end, pace, momentum_coefficient);
}

GEM_CLONES float CoupledRounds::visit_fixed_direction(bool judged, std::int32_t begin, std::int32_t end,
                                                      StepLength<float> pace, float momentum_coefficient) {
  return judged ? visit_range<PointFriction::fixed_direction, true>(begin, end, pace, momentum_coefficient)
                : visit_range<PointFriction::fixed_direction, false>(begin, end, pace, momentum_coefficient);
}

float CoupledRounds::visit(PointFriction law, bool judged, std::int32_t begin, std::int32_t end, StepLength<float> pace,
                           float momentum_coefficient) {
  switch (law) {
    case PointFriction::none:
      return visit_frictionless(judged, begin, end, pace, momentum_coefficient);
    case PointFriction::coulomb:
      return visit_coulomb(judged, begin, end, pace, momentum_coefficient);
    default:
      return visit_fixed_direction(judged, begin, end, pace, momentum_coefficient);
  }
}

GEM_CLONES void CoupledRounds::push(std::int32_t begin, std::int32_t end) {
  for (std::int32_t i = begin; i < end; ++i) write_push(i);
}

GEM_INLINE void CoupledRounds::move_body(std::int32_t entry, const FloatPack& to_b, const FloatPack& to_a) {
  motion_[entry].lanes = answer_[entry].lanes * (__builtin_shufflevector(to_b, to_b, 0, 1, 2, 3, 6, 7, 6, 7) -
                                                 __builtin_shufflevector(to_a, to_a, 0, 1, 2, 3, 4, 5, 4, 5));
}

GEM_INLINE void CoupledRounds::move_any(const CoupledLayout& layout, std::int32_t begin, std::int32_t end) {
  const Row* const push = push_.data();
  const std::uint32_t* const as_b = layout.points_as_b();
  for (std::int32_t k = begin; k < end; ++k) {
    FloatPack to_b{}, to_a{};
    for (std::int32_t s = layout.begin_as_b(k); s < layout.begin_as_b(k + 1); ++s) to_b += push[as_b[s]].lanes;
    for (std::int32_t point = layout.first_as_a(k); point < layout.end_as_a(k); ++point) to_a += push[point].lanes;
    move_body(k, to_b, to_a);
  }
}

/// Bodies with exactly `as_b` and `as_a` points, with the loops unrolled.
template <int as_b, int as_a>
GEM_INLINE void CoupledRounds::move_alike(const CoupledLayout& layout, std::int32_t begin, std::int32_t end) {
  const Row* const push = push_.data();
  const std::uint32_t* point_as_b = layout.points_as_b() + layout.begin_as_b(begin);
  for (std::int32_t k = begin; k < end; ++k, point_as_b += as_b) {
    FloatPack to_b{}, to_a{};
#pragma GCC unroll 8
    for (int s = 0; s < as_b; ++s) to_b += push[point_as_b[s]].lanes;
    const Row* const push_a = push + layout.first_as_a(k);
#pragma GCC unroll 8
    for (int s = 0; s < as_a; ++s) to_a += push_a[s].lanes;
    move_body(k, to_b, to_a);
  }
}

template <int as_b>
GEM_INLINE void CoupledRounds::move_alike(const CoupledLayout& layout, std::int32_t begin, std::int32_t end,
                                          std::int32_t as_a) {
  switch (as_a) {
    case 0:
      return move_alike<as_b, 0>(layout, begin, end);
    case 1:
      return move_alike<as_b, 1>(layout, begin, end);
    case 2:
      return move_alike<as_b, 2>(layout, begin, end);
    case 3:
      return move_alike<as_b, 3>(layout, begin, end);
    case 4:
      return move_alike<as_b, 4>(layout, begin, end);
    default:
      return move_any(layout, begin, end);
  }
}

GEM_CLONES void CoupledRounds::move(const CoupledLayout& layout, std::int32_t begin, std::int32_t end) {
  using Alike = CoupledLayout::Alike;
  const std::vector<Alike>& alike = layout.alike();
  auto group = std::upper_bound(alike.begin(), alike.end(), begin,
                                [](std::int32_t entry, const Alike& a) { return entry < a.last; });
  for (; group != alike.end() && group->first < end; ++group) {
    const std::int32_t first = std::max(begin, group->first), last = std::min(end, group->last);
    switch (group->as_b) {
      case 0:
        move_alike<0>(layout, first, last, group->as_a);
        break;
      case 1:
        move_alike<1>(layout, first, last, group->as_a);
        break;
      case 2:
        move_alike<2>(layout, first, last, group->as_a);
        break;
      case 3:
        move_alike<3>(layout, first, last, group->as_a);
        break;
      case 4:
        move_alike<4>(layout, first, last, group->as_a);
        break;
      default:
        move_any(layout, first, last);
    }
  }
}

}  // namespace gem
