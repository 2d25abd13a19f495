#include "gem/engine/solver/splitting/front_factor.h"

#include <algorithm>

#include "gem/base/pack.h"
#include "gem/engine/solver/splitting/dissection_rules.h"

namespace gem {
namespace {

constexpr std::int32_t motions = 3;  // of a body
constexpr std::int32_t part_columns = motions * part_bodies, chunk_columns = 4 * part_columns;

std::int32_t whole_packs(std::int32_t numbers) { return (numbers + float_lanes - 1) / float_lanes * float_lanes; }

GEM_INLINE FloatPack load_pack(const float* from) {
  FloatPack x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}

GEM_INLINE void store_pack(FloatPack x, float* to) { __builtin_memcpy(to, &x, sizeof x); }

GEM_INLINE FloatHalf load_half(const float* from) {
  FloatHalf x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}

typedef std::int32_t HalfMask __attribute__((vector_size(16)));

}  // namespace

/// The others of a front: later bodies in contact with its own, and the others of its children.
void FrontFactor::find_others(std::span<const std::pair<std::int32_t, std::int32_t>> pairs, std::int32_t node) {
  Front& f = front_[node];
  const std::int32_t end = f.place + f.own;
  f.first_other = static_cast<std::int32_t>(other_place_.size());
  const auto take = [&](std::int32_t place) {
    if (place < end || mark_[place] == node) return;
    mark_[place] = node;
    other_place_.push_back(place);
  };
  for (std::int32_t k = first_pair_[f.place]; k < first_pair_[end]; ++k) take(pairs[k].second);
  for (std::int32_t child = first_child_[node]; child >= 0; child = next_child_[child]) {
    const Front& c = front_[child];
    for (std::int32_t k = 0; k < c.others; ++k) take(other_place_[c.first_other + k]);
  }
  std::sort(other_place_.begin() + f.first_other, other_place_.end());
  f.others = static_cast<std::int32_t>(other_place_.size()) - f.first_other;
}

/// First row of a body in the columns of a front. The rows of the others follow those of the own bodies.
std::int32_t FrontFactor::row_in(const Front& f, std::int32_t place) const {
  if (place < f.place + f.own) return motions * (place - f.place);
  const auto begin = other_place_.begin() + f.first_other;
  return f.own_rows + motions * static_cast<std::int32_t>(std::lower_bound(begin, begin + f.others, place) - begin);
}

void FrontFactor::analyse(const EliminationTree& tree, std::span<const std::pair<std::int32_t, std::int32_t>> pairs) {
  const auto nodes = static_cast<std::int32_t>(tree.node.size());
  const auto bodies = static_cast<std::int32_t>(tree.order.size());
  first_pair_.assign(bodies + 1, 0);
  later_.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    ++first_pair_[pairs[k].first + 1];
    later_[k] = pairs[k].second;
  }
  for (std::int32_t k = 0; k < bodies; ++k) first_pair_[k + 1] += first_pair_[k];
  front_.assign(nodes, {});
  other_place_.clear();
  mark_.assign(bodies, -1);
  first_child_.assign(nodes, -1);
  next_child_.assign(nodes, -1);
  for (std::int32_t k = nodes - 1; k >= 0; --k) {
    const std::int32_t parent = tree.node[k].parent;
    if (parent < 0) continue;
    next_child_[k] = first_child_[parent];
    first_child_[parent] = k;
  }
  std::int32_t most_rows = 0, most_others = 0, most_own = 0;
  std::size_t forth = 0, back = 0;
  for (std::int32_t k = 0; k < nodes; ++k) {
    const EliminationNode& node = tree.node[k];
    Front& f = front_[k];
    f.place = node.begin;
    f.own = node.end - node.begin;
    find_others(pairs, k);
    f.own_rows = whole_packs(motions * f.own);
    f.other_rows = whole_packs(motions * f.others);
    f.forth = forth;
    f.back = back;
    forth += static_cast<std::size_t>(f.other_rows) * motions * f.own;
    back += static_cast<std::size_t>(f.own_rows) * motions * (f.own + f.others);
    most_rows = std::max(most_rows, f.own_rows + f.other_rows);
    most_own = std::max(most_own, f.own);
    most_others = std::max(most_others, f.others);
  }
  row_in_parent_.resize(other_place_.size());
  for (std::int32_t node = 0; node < nodes; ++node) {
    const Front& f = front_[node];
    for (std::int32_t k = 0; k < f.others; ++k)
      row_in_parent_[f.first_other + k] = row_in(front_[tree.node[node].parent], other_place_[f.first_other + k]);
  }
  diagonal_.resize(block * bodies);
  below_.resize(block * pairs.size());
  forth_.resize(forth);
  back_.resize(back);
  for (std::vector<float>& numbers : dense_) numbers.resize(most_rows + float_lanes);  // a body is copied as four
  for (std::vector<float>& numbers : product_) numbers.resize(most_rows + float_lanes);
  own_columns_.resize(static_cast<std::size_t>(most_rows) * (motions * most_own + 1));
  other_columns_.resize(static_cast<std::size_t>(whole_packs(motions * most_others)) * motions * most_others);
}

void FrontFactor::reset() {
  std::fill(below_.begin(), below_.end(), 0.0F);
  std::fill(diagonal_.begin(), diagonal_.end(), 0.0F);
}

/// Adds the complement of a child, of which the part on and below the diagonal is set.
void FrontFactor::add_child(const Front& child, const float* from, const Front& f) {
  const std::int32_t rows = f.own_rows + f.other_rows, from_rows = child.other_rows;
  const auto row_of = [&](std::int32_t k) { return row_in_parent_[child.first_other + k]; };
  for (std::int32_t j = 0; j < child.others; ++j) {
    const std::int32_t to_column = row_of(j);
    for (std::int32_t c = 0; c < motions; ++c) {
      const float* const column = from + static_cast<std::size_t>(from_rows) * (motions * j + c);
      const bool own = to_column < f.own_rows;
      // the rows of others stand behind the own rows
      float* const to =
          own ? &own_columns_[static_cast<std::size_t>(rows) * (to_column + c)]
              : &other_columns_[static_cast<std::size_t>(f.other_rows) * (to_column - f.own_rows + c)] - f.own_rows;
      for (std::int32_t i = j; i < child.others; ++i) {
        float* const at = to + row_of(i);
        for (std::int32_t r = i == j ? c : 0; r < motions; ++r) at[r] += column[motions * i + r];
      }
    }
  }
}

/// Sums the columns of a front: its own blocks, and the complements of its children, which are not needed any more.
void FrontFactor::assemble(std::int32_t node) {
  const Front& f = front_[node];
  const std::int32_t rows = f.own_rows + f.other_rows, own = motions * f.own;
  std::fill_n(own_columns_.begin(), static_cast<std::size_t>(rows) * own, 0.0F);
  std::fill_n(other_columns_.begin(), static_cast<std::size_t>(f.other_rows) * motions * f.others, 0.0F);
  for (std::int32_t i = 0; i < f.own; ++i) {
    const std::int32_t place = f.place + i;
    const auto add_block = [&](std::int32_t row, const float* from) {
      for (std::int32_t r = 0; r < motions; ++r)
        for (std::int32_t c = 0; c < motions; ++c)
          own_columns_[static_cast<std::size_t>(rows) * (motions * i + c) + row + r] = from[motions * r + c];
    };
    add_block(motions * i, diagonal(place));
    for (std::int32_t k = first_pair_[place]; k < first_pair_[place + 1]; ++k)
      add_block(row_in(f, later_[k]), below(k));
  }
  const std::int32_t first = first_child_[node];
  for (std::int32_t child = first; child >= 0; child = next_child_[child])
    add_child(front_[child], waiting_.data() + waiting_from_[child], f);
  if (first >= 0) waiting_.resize(waiting_from_[first]);
  for (std::int32_t c = 0; c < own; ++c)
    for (std::int32_t r = 0; r < c; ++r)
      own_columns_[static_cast<std::size_t>(rows) * c + r] = own_columns_[static_cast<std::size_t>(rows) * r + c];
}

/// Replaces the own block of a front by its inverse (Gauss and Jordan, in place).
GEM_INLINE void FrontFactor::invert_own(const Front& f) {
  const std::size_t rows = f.own_rows + f.other_rows;
  const std::int32_t own = motions * f.own;
  float* const pivot_column = &own_columns_[rows * own];  // room behind the columns
  for (std::int32_t k = 0; k < own; ++k) {
    float* const column = &own_columns_[rows * k];
    const float inverse = 1.0F / column[k];
    for (std::int32_t r = 0; r < f.own_rows; ++r) pivot_column[r] = column[r];
    pivot_column[k] = 0.0F;
    for (std::int32_t r = 0; r < f.own_rows; ++r) column[r] = 0.0F;
    column[k] = 1.0F;
    for (std::int32_t j = 0; j < own; ++j) {
      float* const to = &own_columns_[rows * j];
      const float share = to[k] * inverse;
      for (std::int32_t r = 0; r < f.own_rows; r += float_lanes)
        store_pack(load_pack(to + r) - load_pack(pivot_column + r) * share, to + r);
      to[k] = share;
    }
  }
}

/// Sets G and H of a front, and its complement.
GEM_INLINE void FrontFactor::set_products(const Front& f) {
  const std::size_t rows = f.own_rows + f.other_rows;
  const std::int32_t own = motions * f.own, others = motions * f.others;
  float* const g = back_.data() + f.back;
  float* const h = forth_.data() + f.forth;
  for (std::int32_t k = 0; k < own; ++k)
    std::copy_n(&own_columns_[rows * k], f.own_rows, g + static_cast<std::size_t>(f.own_rows) * k);
  if (others == 0) return;
  const float* const c = &own_columns_[f.own_rows];
  constexpr std::int32_t wide = 3;
  // H = -C A^-1
  for (std::int32_t r = 0; r < f.other_rows; r += float_lanes)
    for (std::int32_t j = 0; j < own; j += wide) {
      FloatPack sum[wide] = {};
      for (std::int32_t k = 0; k < own; ++k) {
        const FloatPack x = load_pack(c + rows * k + r);
        const float* const inverse = g + static_cast<std::size_t>(f.own_rows) * k + j;
        for (std::int32_t q = 0; q < wide; ++q) sum[q] -= x * inverse[q];
      }
      for (std::int32_t q = 0; q < wide; ++q)
        store_pack(sum[q], h + static_cast<std::size_t>(f.other_rows) * (j + q) + r);
    }
  for (std::int32_t m = 0; m < others; ++m) {
    float* const column = g + static_cast<std::size_t>(f.own_rows) * (own + m);
    for (std::int32_t r = own; r < f.own_rows; ++r) column[r] = 0.0F;
    for (std::int32_t j = 0; j < own; ++j) column[j] = h[static_cast<std::size_t>(f.other_rows) * j + m];
  }
  // the complement, on and below the diagonal
  for (std::int32_t m = 0; m < others; m += wide)
    for (std::int32_t r = m / float_lanes * float_lanes; r < f.other_rows; r += float_lanes) {
      float* const to = &other_columns_[static_cast<std::size_t>(f.other_rows) * m + r];
      FloatPack sum[wide];
      for (std::int32_t q = 0; q < wide; ++q) sum[q] = load_pack(to + f.other_rows * q);
      for (std::int32_t k = 0; k < own; ++k) {
        const FloatPack x = load_pack(h + static_cast<std::size_t>(f.other_rows) * k + r);
        const float* const other = c + rows * k + m;
        for (std::int32_t q = 0; q < wide; ++q) sum[q] += x * other[q];
      }
      for (std::int32_t q = 0; q < wide; ++q) store_pack(sum[q], to + f.other_rows * q);
    }
}

GEM_CLONES void FrontFactor::factor() {
  waiting_.clear();
  waiting_from_.resize(front_.size());
  for (std::size_t k = 0; k < front_.size(); ++k) {
    const Front& f = front_[k];
    assemble(static_cast<std::int32_t>(k));
    invert_own(f);
    set_products(f);
    waiting_from_[k] = waiting_.size();
    waiting_.insert(waiting_.end(), other_columns_.begin(),
                    other_columns_.begin() + static_cast<std::ptrdiff_t>(f.other_rows) * motions * f.others);
  }
}

namespace {

/// The products of some packs of rows and columns [first, first + count) of a chunk, in four parts.
template <int vectors, int count>
GEM_INLINE void add_chunk(const float* at, std::int32_t rows, const float* const* x, std::int32_t first,
                          FloatPack (&total)[vectors]) {
  FloatPack part[vectors][4] = {};
  for (std::int32_t i = 0; i < part_columns; ++i)
    for (std::int32_t p = 0; p < 4; ++p) {
      const std::int32_t k = part_columns * p + i;
      if (k >= count) continue;
      const FloatPack column = load_pack(at + static_cast<std::ptrdiff_t>(rows) * k);
      for (int v = 0; v < vectors; ++v) part[v][p] += column * x[v][first + k];
    }
  for (int v = 0; v < vectors; ++v) total[v] += (part[v][0] + part[v][1]) + (part[v][2] + part[v][3]);
}

/// Some packs of rows of a matrix times every vector: chunk by chunk of its columns.
template <int vectors>
GEM_INLINE void multiply(const float* matrix, std::int32_t rows, std::int32_t columns, const float* const* x,
                         FloatPack (&total)[vectors]) {
  std::int32_t k = 0;
  for (; k + chunk_columns <= columns; k += chunk_columns)
    add_chunk<vectors, chunk_columns>(matrix + static_cast<std::ptrdiff_t>(rows) * k, rows, x, k, total);
  const float* const rest = matrix + static_cast<std::ptrdiff_t>(rows) * k;
  switch ((columns - k) / motions) {
    case 1:
      return add_chunk<vectors, 3>(rest, rows, x, k, total);
    case 2:
      return add_chunk<vectors, 6>(rest, rows, x, k, total);
    case 3:
      return add_chunk<vectors, 9>(rest, rows, x, k, total);
    case 4:
      return add_chunk<vectors, 12>(rest, rows, x, k, total);
    case 5:
      return add_chunk<vectors, 15>(rest, rows, x, k, total);
    case 6:
      return add_chunk<vectors, 18>(rest, rows, x, k, total);
    case 7:
      return add_chunk<vectors, 21>(rest, rows, x, k, total);
    default:
      return;
  }
}

/// Copies the numbers of a body from its row to place `k` of dense vectors. Each copy has one number too many.
template <int vectors>
GEM_INLINE void take_body(const float* row, std::int32_t k, float* const* to) {
  for (int v = 0; v < vectors; ++v) {
    const FloatHalf x = load_half(row + 4 * v);
    __builtin_memcpy(to[v] + motions * k, &x, sizeof x);
  }
}

/// The numbers of a body, from place `k` of a dense vector; the fourth is zero.
GEM_INLINE FloatHalf body_of(const float* from, std::int32_t k) {
  const HalfMask three{-1, -1, -1, 0};
  const FloatHalf x = load_half(from + motions * k);
  return three ? x : FloatHalf{};
}

}  // namespace

template <int vectors>
GEM_INLINE void FrontFactor::forth(const Front& f, float* x) {
  if (f.others == 0) return;
  float* const own[2] = {dense_[0].data(), dense_[1].data()};
  float* const result[2] = {product_[0].data(), product_[1].data()};
  for (std::int32_t k = 0; k < f.own; ++k) take_body<vectors>(x + row_numbers * (f.place + k), k, own);
  for (std::int32_t r = 0; r < f.other_rows; r += float_lanes) {
    FloatPack sum[vectors] = {};
    multiply<vectors>(forth_.data() + f.forth + r, f.other_rows, motions * f.own, own, sum);
    for (int v = 0; v < vectors; ++v) store_pack(sum[v], result[v] + r);
  }
  for (std::int32_t k = 0; k < f.others; ++k) {
    float* const row = x + row_numbers * other_place_[f.first_other + k];
    for (int v = 0; v < vectors; ++v) {
      const FloatHalf sum = load_half(row + 4 * v) + body_of(result[v], k);
      __builtin_memcpy(row + 4 * v, &sum, sizeof sum);
    }
  }
}

template <int vectors>
GEM_INLINE void FrontFactor::back(const Front& f, float* x) {
  float* const all[2] = {dense_[0].data(), dense_[1].data()};
  float* const result[2] = {product_[0].data(), product_[1].data()};
  for (std::int32_t k = 0; k < f.own; ++k) take_body<vectors>(x + row_numbers * (f.place + k), k, all);
  for (std::int32_t k = 0; k < f.others; ++k)
    take_body<vectors>(x + row_numbers * other_place_[f.first_other + k], f.own + k, all);
  for (std::int32_t r = 0; r < f.own_rows; r += float_lanes) {
    FloatPack sum[vectors] = {};
    multiply<vectors>(back_.data() + f.back + r, f.own_rows, motions * (f.own + f.others), all, sum);
    for (int v = 0; v < vectors; ++v) store_pack(sum[v], result[v] + r);
  }
  for (std::int32_t k = 0; k < f.own; ++k)
    for (int v = 0; v < vectors; ++v) {
      const FloatHalf x_of_body = body_of(result[v], k);
      __builtin_memcpy(x + row_numbers * (f.place + k) + 4 * v, &x_of_body, sizeof x_of_body);
    }
}

template <int vectors>
GEM_INLINE void FrontFactor::solve_all(float* x) {
  for (const Front& f : front_) forth<vectors>(f, x);
  for (std::size_t k = front_.size(); k-- > 0;) back<vectors>(front_[k], x);
}

GEM_CLONES void FrontFactor::solve_first(float* x) { solve_all<1>(x); }
GEM_CLONES void FrontFactor::solve_both(float* x) { solve_all<2>(x); }

}  // namespace gem
