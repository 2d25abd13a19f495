// The numbers of the factor.
#include "gem/engine/solver/splitting/factor/front_factor.h"

#include <algorithm>

#include "gem/engine/solver/splitting/factor/front_panels.h"

namespace gem {

void FrontFactor::reset() {
  std::fill(below_.begin(), below_.end(), 0.0F);
  std::fill(diagonal_.begin(), diagonal_.end(), 0.0F);
}

/// Adds the complement of a child, of which the part on and below the diagonal is set.
void FrontFactor::add_child(const Front& child, const float* from, const Front& f, Memory& m) {
  const std::int32_t rows = f.own_rows + f.other_rows, from_rows = child.other_rows;
  const auto row_of = [&](std::int32_t k) { return row_in_parent_[child.first_other + k]; };
  for (std::int32_t j = 0; j < child.others; ++j) {
    const std::int32_t to_column = row_of(j);
    for (std::int32_t c = 0; c < motions; ++c) {
      const float* const column = from + static_cast<std::size_t>(from_rows) * (motions * j + c);
      const bool own = to_column < f.own_rows;
      // the rows of others stand behind the own rows
      float* const to =
          own ? &m.own_columns[static_cast<std::size_t>(rows) * (to_column + c)]
              : &m.other_columns[static_cast<std::size_t>(f.other_rows) * (to_column - f.own_rows + c)] - f.own_rows;
      for (std::int32_t i = j; i < child.others; ++i) {
        float* const at = to + row_of(i);
        for (std::int32_t r = i == j ? c : 0; r < motions; ++r) at[r] += column[motions * i + r];
      }
    }
  }
}

/// Sums the columns of a front: its own blocks, and the complements of its children, which are not needed any more.
void FrontFactor::assemble(std::int32_t node, Memory& m) {
  const Front& f = front_[node];
  const std::int32_t rows = f.own_rows + f.other_rows, own = motions * f.own;
  std::fill_n(m.own_columns.begin(), static_cast<std::size_t>(rows) * own, 0.0F);
  std::fill_n(m.other_columns.begin(), static_cast<std::size_t>(f.other_rows) * motions * f.others, 0.0F);
  for (std::int32_t i = 0; i < f.own; ++i) {
    const std::int32_t place = f.place + i;
    const auto add_block = [&](std::int32_t row, const float* from) {
      for (std::int32_t r = 0; r < motions; ++r)
        for (std::int32_t c = 0; c < motions; ++c)
          m.own_columns[static_cast<std::size_t>(rows) * (motions * i + c) + row + r] = from[motions * r + c];
    };
    add_block(motions * i, diagonal(place));
    for (std::int32_t k = first_pair_[place]; k < first_pair_[place + 1]; ++k)
      add_block(row_in(f, later_[k]), below(k));
  }
  const std::int32_t first = first_child_[node];
  for (std::int32_t child = first; child >= 0; child = next_child_[child])
    add_child(front_[child], memory_[parts_.part_of[child]].waiting.data() + waiting_from_[child], f, m);
  if (first >= 0 && parts_.part_of[first] == parts_.part_of[node]) m.waiting.resize(waiting_from_[first]);
  for (std::int32_t c = 0; c < own; ++c)
    for (std::int32_t r = 0; r < c; ++r)
      m.own_columns[static_cast<std::size_t>(rows) * c + r] = m.own_columns[static_cast<std::size_t>(rows) * r + c];
}

/// Replaces the own block of a front by its inverse (Gauss and Jordan, in place).
GEM_INLINE void FrontFactor::invert_own(const Front& f, Memory& m) {
  const std::size_t rows = f.own_rows + f.other_rows;
  const std::int32_t own = motions * f.own;
  float* const pivot_column = &m.own_columns[rows * own];  // room behind the columns
  for (std::int32_t k = 0; k < own; ++k) {
    float* const column = &m.own_columns[rows * k];
    const float inverse = 1.0F / column[k];
    for (std::int32_t r = 0; r < f.own_rows; ++r) pivot_column[r] = column[r];
    pivot_column[k] = 0.0F;
    for (std::int32_t r = 0; r < f.own_rows; ++r) column[r] = 0.0F;
    column[k] = 1.0F;
    for (std::int32_t j = 0; j < own; ++j) {
      float* const to = &m.own_columns[rows * j];
      const float share = to[k] * inverse;
      for (std::int32_t r = 0; r < f.own_rows; r += float_lanes)
        store_as(load_as<FloatPack>(to + r) - load_as<FloatPack>(pivot_column + r) * share, to + r);
      to[k] = share;
    }
  }
}

namespace {

/// Adds sum over k of a(:, k) b(k, :) to some columns of a pack of rows, or takes it away. Numbers of a column of `a`
/// follow each other, those of a row of `b` too.
template <class Pack, int columns, bool minus>
GEM_INLINE void add_products(std::int32_t count, const float* a, std::size_t a_stride, const float* b,
                             std::size_t b_stride, Pack (&sum)[columns]) {
  for (std::int32_t k = 0; k < count; ++k) {
    const Pack x = load_as<Pack>(a + a_stride * k);
    const float* const y = b + b_stride * k;
    for (int q = 0; q < columns; ++q) {
      if constexpr (minus)
        sum[q] -= x * y[q];
      else
        sum[q] += x * y[q];
    }
  }
}

/// Eight columns of eight rows into eight rows of eight columns.
GEM_INLINE void transpose(FloatPack* r) {
  transpose_halves(r);
  transpose_halves(r + 4);
  for (int k = 0; k < 4; ++k) {
    const FloatPack low = r[k], high = r[k + 4];
    r[k] = __builtin_shufflevector(low, high, 0, 1, 2, 3, 8, 9, 10, 11);
    r[k + 4] = __builtin_shufflevector(low, high, 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

}  // namespace

/// H = -C A^-1, some columns of a pack of rows.
template <class Pack, int columns>
GEM_INLINE void FrontFactor::set_forth(const Front& f, std::int32_t r, std::int32_t column, Memory& m) {
  const std::size_t rows = f.own_rows + f.other_rows;
  const std::int32_t own = motions * f.own;
  Pack sum[columns] = {};
  add_products<Pack, columns, true>(own, &m.own_columns[f.own_rows + r], rows, &m.own_columns[column], rows, sum);
  for (int q = 0; q < columns; ++q)
    store_as(sum[q], forth_.data() + f.forth + place_in_panels(f.other_rows, own, r, column + q));
}

/// Some columns of a pack of rows of the complement.
template <class Pack, int columns>
GEM_INLINE void FrontFactor::set_complement(const Front& f, std::int32_t r, std::int32_t column, Memory& m) {
  const std::size_t rows = f.own_rows + f.other_rows;
  const std::int32_t own = motions * f.own;
  float* const to = &m.other_columns[static_cast<std::size_t>(f.other_rows) * column + r];
  Pack sum[columns];
  for (int q = 0; q < columns; ++q) sum[q] = load_as<Pack>(to + f.other_rows * q);
  const float* const h = forth_.data() + f.forth + place_in_panels(f.other_rows, own, r, 0);
  add_products<Pack, columns, false>(own, h, rows_of_panel(f.other_rows, r / panel_rows * panel_rows),
                                     &m.own_columns[f.own_rows + column], rows, sum);
  for (int q = 0; q < columns; ++q) store_as(sum[q], to + f.other_rows * q);
}

/// Sets G of a front from the inverse of its own block and from H.
GEM_INLINE void FrontFactor::set_back(const Front& f, Memory& m) {
  const std::size_t rows = f.own_rows + f.other_rows;
  const std::int32_t own = motions * f.own, others = motions * f.others, columns = own + others;
  const float* const h = forth_.data() + f.forth;
  for (std::int32_t r = 0; r < f.own_rows; r += float_lanes) {
    const std::int32_t width = rows_of_panel(f.own_rows, r / panel_rows * panel_rows);
    float* const g = back_.data() + f.back + place_in_panels(f.own_rows, columns, r, 0);
    for (std::int32_t k = 0; k < own; ++k) store_as(load_as<FloatPack>(&m.own_columns[rows * k + r]), g + width * k);
    for (std::int32_t other = 0; other < others; other += float_lanes) {
      FloatPack cell[float_lanes];
      for (std::int32_t q = 0; q < float_lanes; ++q)
        cell[q] = r + q < own ? load_as<FloatPack>(h + place_in_panels(f.other_rows, own, other, r + q)) : FloatPack{};
      transpose(cell);
      for (std::int32_t q = 0; q < float_lanes && other + q < others; ++q)
        store_as(cell[q], g + width * (own + other + q));
    }
  }
}

/// Sets H and G of a front, and its complement on and below the diagonal.
template <class Wide>
GEM_INLINE void FrontFactor::set_products(const Front& f, Memory& m) {
  const std::int32_t own = motions * f.own, others = motions * f.others;
  constexpr std::int32_t most = 2 * motions;
  for (std::int32_t r = 0; r < f.other_rows;) {
    const bool whole = r + lanes_of<Wide> <= f.other_rows;
    std::int32_t c = 0;
    for (; c + most <= own; c += most)
      whole ? set_forth<Wide, most>(f, r, c, m) : set_forth<FloatPack, most>(f, r, c, m);
    if (c < own) whole ? set_forth<Wide, motions>(f, r, c, m) : set_forth<FloatPack, motions>(f, r, c, m);
    r += whole ? lanes_of<Wide> : float_lanes;
  }
  set_back(f, m);
  for (std::int32_t c = 0; c < others;) {
    const bool two = c + most <= others;
    for (std::int32_t r = c / lanes_of<Wide> * lanes_of<Wide>; r < f.other_rows;) {
      const bool whole = r + lanes_of<Wide> <= f.other_rows;
      if (two)
        whole ? set_complement<Wide, most>(f, r, c, m) : set_complement<FloatPack, most>(f, r, c, m);
      else
        whole ? set_complement<Wide, motions>(f, r, c, m) : set_complement<FloatPack, motions>(f, r, c, m);
      r += whole ? lanes_of<Wide> : float_lanes;
    }
    c += two ? most : motions;
  }
}

template <class Wide>
GEM_INLINE void FrontFactor::factor_nodes(std::int32_t part) {
  Memory& m = memory_[part];
  m.waiting.clear();
  for (const std::int32_t k : nodes_of(part)) {
    const Front& f = front_[k];
    assemble(k, m);
    invert_own(f, m);
    set_products<Wide>(f, m);
    waiting_from_[k] = m.waiting.size();
    m.waiting.insert(m.waiting.end(), m.other_columns.begin(),
                     m.other_columns.begin() + static_cast<std::ptrdiff_t>(f.other_rows) * motions * f.others);
  }
}

GEM_CLONES void FrontFactor::factor_narrow(std::int32_t part) { factor_nodes<FloatPack>(part); }
GEM_WIDE void FrontFactor::factor_wide(std::int32_t part) { factor_nodes<FloatWide>(part); }
void FrontFactor::factor_part(std::int32_t part) { has_wide_packs() ? factor_wide(part) : factor_narrow(part); }

void FrontFactor::factor(IslandCrew& crew) {
  if (trunk() > 1) crew.share([this](int part) { factor_part(part); });
  factor_part(trunk());
}

}  // namespace gem
