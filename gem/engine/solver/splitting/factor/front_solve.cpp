// The solution of the equations of an island by its factor.
#include "gem/engine/solver/splitting/factor/front_factor.h"
#include "gem/engine/solver/splitting/factor/front_panels.h"

namespace gem {
namespace {

typedef std::int32_t HalfMask __attribute__((vector_size(16)));

/// Copies the numbers of a body from its row to place `k` of dense vectors. Each copy has one number too many.
template <int vectors>
GEM_INLINE void take_body(const float* row, std::int32_t k, float* const* to) {
  for (int v = 0; v < vectors; ++v) store_as(load_as<FloatHalf>(row + 4 * v), to[v] + motions * k);
}

/// The numbers of a body, from place `k` of a dense vector; the fourth is zero.
GEM_INLINE FloatHalf body_of(const float* from, std::int32_t k) {
  const HalfMask three{-1, -1, -1, 0};
  const FloatHalf x = load_as<FloatHalf>(from + motions * k);
  return three ? x : FloatHalf{};
}

}  // namespace

template <class Wide, int vectors>
GEM_INLINE void FrontFactor::forth(const Front& f, float* x, Memory& m) {
  if (f.others == 0) return;
  float* const own[2] = {m.dense[0].data(), m.dense[1].data()};
  float* const result[2] = {m.product[0].data(), m.product[1].data()};
  for (std::int32_t k = 0; k < f.own; ++k) take_body<vectors>(x + row_numbers * (f.place + k), k, own);
  multiply<Wide, vectors>(forth_.data() + f.forth, f.other_rows, motions * f.own, own, result);
  for (std::int32_t k = 0; k < f.adds; ++k) {
    float* const row = x + row_numbers * other_place_[f.first_other + k];
    for (int v = 0; v < vectors; ++v) store_as(load_as<FloatHalf>(row + 4 * v) + body_of(result[v], k), row + 4 * v);
  }
  float* row = kept_.data() + row_numbers * f.first_kept;
  for (std::int32_t k = f.adds; k < f.others; ++k, row += row_numbers)
    for (int v = 0; v < vectors; ++v) store_as(body_of(result[v], k), row + 4 * v);
}

/// Adds the sums that a front of a part keeps to the rows of the trunk.
template <int vectors>
GEM_INLINE void FrontFactor::add_kept(const Front& f, float* x) const {
  const float* from = kept_.data() + row_numbers * f.first_kept;
  for (std::int32_t k = f.adds; k < f.others; ++k, from += row_numbers) {
    float* const row = x + row_numbers * other_place_[f.first_other + k];
    for (int v = 0; v < vectors; ++v)
      store_as(load_as<FloatHalf>(row + 4 * v) + load_as<FloatHalf>(from + 4 * v), row + 4 * v);
  }
}

template <class Wide, int vectors>
GEM_INLINE void FrontFactor::back(const Front& f, float* x, Memory& m) {
  float* const all[2] = {m.dense[0].data(), m.dense[1].data()};
  float* const result[2] = {m.product[0].data(), m.product[1].data()};
  for (std::int32_t k = 0; k < f.own; ++k) take_body<vectors>(x + row_numbers * (f.place + k), k, all);
  for (std::int32_t k = 0; k < f.others; ++k)
    take_body<vectors>(x + row_numbers * other_place_[f.first_other + k], f.own + k, all);
  multiply<Wide, vectors>(back_.data() + f.back, f.own_rows, motions * (f.own + f.others), all, result);
  for (std::int32_t k = 0; k < f.own; ++k)
    for (int v = 0; v < vectors; ++v) store_as(body_of(result[v], k), x + row_numbers * (f.place + k) + 4 * v);
}

/// Rows of the trunk get their sums in the order of the nodes, as if there were no parts.
template <class Wide, int vectors>
GEM_INLINE void FrontFactor::solve_part(Way way, std::int32_t part, float* x) {
  Memory& m = memory_[part];
  const std::vector<std::int32_t>& nodes = nodes_of(part);
  if (way == Way::back) {
    for (std::size_t k = nodes.size(); k-- > 0;) back<Wide, vectors>(front_[nodes[k]], x, m);
    return;
  }
  auto keeping = keeping_.begin();
  for (const std::int32_t node : nodes) {
    if (part == trunk())
      for (; keeping != keeping_.end() && *keeping < node; ++keeping) add_kept<vectors>(front_[*keeping], x);
    forth<Wide, vectors>(front_[node], x, m);
  }
}

GEM_CLONES void FrontFactor::solve_first_narrow(Way way, std::int32_t part, float* x) {
  solve_part<FloatPack, 1>(way, part, x);
}
GEM_CLONES void FrontFactor::solve_both_narrow(Way way, std::int32_t part, float* x) {
  solve_part<FloatPack, 2>(way, part, x);
}
GEM_WIDE void FrontFactor::solve_first_wide(Way way, std::int32_t part, float* x) {
  solve_part<FloatWide, 1>(way, part, x);
}
GEM_WIDE void FrontFactor::solve_both_wide(Way way, std::int32_t part, float* x) {
  solve_part<FloatWide, 2>(way, part, x);
}

/// Calls pass(way, part) for all parts and the trunk.
template <class Pass>
void FrontFactor::solve(IslandCrew& crew, Pass&& pass) {
  if (trunk() > 1) crew.share([&](int part) { pass(Way::forth, part); });
  pass(Way::forth, trunk());
  pass(Way::back, trunk());
  if (trunk() > 1) crew.share([&](int part) { pass(Way::back, part); });
}

void FrontFactor::solve_first(float* x, IslandCrew& crew) {
  solve(crew, [&](Way way, std::int32_t part) {
    has_wide_packs() ? solve_first_wide(way, part, x) : solve_first_narrow(way, part, x);
  });
}
void FrontFactor::solve_both(float* x, IslandCrew& crew) {
  solve(crew, [&](Way way, std::int32_t part) {
    has_wide_packs() ? solve_both_wide(way, part, x) : solve_both_narrow(way, part, x);
  });
}

}  // namespace gem
