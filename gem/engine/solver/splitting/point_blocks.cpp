#include "gem/engine/solver/splitting/point_blocks.h"

namespace gem {
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
  gem::set_point(q, lane, g, of_a, of_b);
}

void PointBlocks::set_base(PointFriction law, std::int32_t k, const PointGeometry<double>& g, SpareFriction spare,
                           const PointImpulse<double>& impulse, const Motion<double>& a, const Motion<double>& b) {
  Block& q = block_[k / float_lanes];
  const std::int32_t lane = k % float_lanes;
  gem::set_base(q, lane, law, g, spare, impulse, a, b);
  repairs_ = repairs_ || gem::repairs(g, impulse);
}

void PointBlocks::stiffen(float stiffness, bool raised, FrontFactor& factor) {
  for (Block& q : block_) {
    stiffen_point(q, stiffness, raised);
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

template <bool repairs>
GEM_INLINE void PointBlocks::push_blocks(const std::vector<BodyRow>& now, std::vector<BodyRow>& to) const {
  for (const Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(now, q.a, a);
    load_motions<0>(now, q.b, b);
    const PointShare<FloatPack> share = push_of(q, a, b);
    PointShare<FloatPack> repair{};
    if constexpr (repairs) {
      load_motions<1>(now, q.a, a);
      load_motions<1>(now, q.b, b);
      repair = repair_push_of(q, a, b);
    }
    add_pushes<repairs>(q, share, repair, to);
  }
}

template <PointFriction law, bool repairs, bool keeps>
GEM_INLINE void PointBlocks::visit_blocks(const Visit& v) {
  for (std::int32_t k = v.first; k < v.last; ++k) {
    Block& q = block_[k];
    FloatPack a[4], b[4];
    load_motions<0>(v.now, q.a, a);
    load_motions<0>(v.now, q.b, b);
    const PointShare<FloatPack> share = visit_point<law>(q, a, b);
    PointShare<FloatPack> repair{};
    if constexpr (repairs) {
      load_motions<1>(v.now, q.a, a);
      load_motions<1>(v.now, q.b, b);
      repair = visit_repair(q, a, b);
    }
    const BlockPushes<repairs> pushes = pushes_of<repairs>(q, share, repair);
    if constexpr (keeps)
      __builtin_memcpy(&kept_[k], &pushes, sizeof pushes);
    else
      add_block_pushes(v.sum, q.a, q.b, pushes);
  }
}

/// Adds the kept pushes of all blocks from `first` on.
template <bool repairs>
GEM_INLINE void PointBlocks::add_kept_blocks(std::int32_t first, std::vector<BodyRow>& sum) const {
  for (std::size_t k = first; k < block_.size(); ++k) {
    BlockPushes<repairs> pushes;
    __builtin_memcpy(&pushes, &kept_[k], sizeof pushes);
    add_block_pushes(sum, block_[k].a, block_[k].b, pushes);
  }
}

GEM_CLONES void PointBlocks::add_kept(std::int32_t first, std::vector<BodyRow>& sum) const {
  repairs_ ? add_kept_blocks<true>(first, sum) : add_kept_blocks<false>(first, sum);
}

GEM_CLONES void PointBlocks::push(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) const {
  repairs_ ? push_blocks<true>(now, sum) : push_blocks<false>(now, sum);
}

template <PointFriction law>
GEM_INLINE void PointBlocks::visit_law(const Visit& v) {
  if (v.keeps)
    repairs_ ? visit_blocks<law, true, true>(v) : visit_blocks<law, false, true>(v);
  else
    repairs_ ? visit_blocks<law, true, false>(v) : visit_blocks<law, false, false>(v);
}

GEM_CLONES void PointBlocks::visit_frictionless(const Visit& v) { visit_law<PointFriction::none>(v); }
GEM_CLONES void PointBlocks::visit_coulomb(const Visit& v) { visit_law<PointFriction::coulomb>(v); }
GEM_CLONES void PointBlocks::visit_fixed_direction(const Visit& v) { visit_law<PointFriction::fixed_direction>(v); }

void PointBlocks::visit(PointFriction law, const Visit& v) {
  if (law == PointFriction::none) visit_frictionless(v);
  if (law == PointFriction::coulomb) visit_coulomb(v);
  if (law == PointFriction::fixed_direction) visit_fixed_direction(v);
}

/// The first part adds its pushes at once. Those of the others are added after it, so that each body gets its pushes in
/// the order of the points.
void PointBlocks::visit(PointFriction law, const std::vector<BodyRow>& now, std::vector<BodyRow>& sum,
                        IslandCrew& crew) {
  const auto blocks = static_cast<std::int64_t>(block_.size());
  const int parts = crew.parts();
  if (parts > 1) kept_.resize(block_.size());
  const auto first_of = [&](int part) { return static_cast<std::int32_t>(blocks * part / parts); };
  crew.share([&](int part) { visit(law, {now, sum, first_of(part), first_of(part + 1), part > 0}); });
  if (parts > 1) add_kept(first_of(1), sum);
}

template <PointFriction law, bool repairs>
GEM_INLINE void PointBlocks::answer_blocks(const std::vector<BodyRow>& now, std::vector<BodyRow>& to) {
  for (Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(now, q.a, a);
    load_motions<0>(now, q.b, b);
    const PointShare<FloatPack> share = answer_point<law>(q, a, b);
    PointShare<FloatPack> repair{};
    if constexpr (repairs) {
      load_motions<1>(now, q.a, a);
      load_motions<1>(now, q.b, b);
      repair = answer_repair(q, a, b);
    }
    add_pushes<repairs>(q, share, repair, to);
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
  for (Block& q : block_) {
    FloatPack a[4], b[4];
    load_motions<0>(now, q.a, a);
    load_motions<0>(now, q.b, b);
    watch_point(q, a, b, tolerance);
  }
}

bool PointBlocks::raise() {
  FloatPack any{};
  for (Block& q : block_) any = larger(any, raise_point(q));
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
    worst = larger(worst, mismatch_of(q, a, b));
    if (!repairs_) continue;
    load_motions<1>(now, q.a, a);
    load_motions<1>(now, q.b, b);
    worst = larger(worst, per_step * repair_mismatch_of(q, a, b));
  }
  float all = 0.0F;
  for (int lane = 0; lane < float_lanes; ++lane) all = larger(all, worst[lane]);
  return all;
}

void PointBlocks::add_to(PointFriction law, std::int32_t k, const PointGeometry<double>& g, SpareFriction spare,
                         PointImpulse<double>& impulse) const {
  const Block& q = block_[k / float_lanes];
  const std::int32_t lane = k % float_lanes;
  impulse = with_answer(q, lane, law, g, spare, impulse);
}

}  // namespace gem
