// The matrices of a front in memory, and their products.
//
// A matrix stands in panels of sixteen rows, and one of eight rows where no more are left. Within a panel its columns
// follow each other, so a product reads the numbers in the order in which they stand.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gem/base/pack.h"
#include "gem/engine/solver/splitting/factor/dissection_rules.h"

namespace gem {

constexpr std::int32_t motions = 3;  // of a body
constexpr std::int32_t part_columns = motions * part_bodies, chunk_columns = 4 * part_columns;
constexpr std::int32_t panel_rows = 2 * float_lanes;

/// Rows of the panel that begins at row `r` of `rows`.
GEM_INLINE std::int32_t rows_of_panel(std::int32_t rows, std::int32_t r) {
  return r + panel_rows <= rows ? panel_rows : float_lanes;
}

/// Place of a number among those of its matrix. `rows`: whole packs.
GEM_INLINE std::size_t place_in_panels(std::int32_t rows, std::int32_t columns, std::int32_t row, std::int32_t column) {
  const std::int32_t first = row / panel_rows * panel_rows;
  return static_cast<std::size_t>(first) * columns + rows_of_panel(rows, first) * column + row - first;
}

template <class Pack>
GEM_INLINE Pack load_as(const float* from) {
  Pack x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}

template <class Pack>
GEM_INLINE void store_as(const Pack& x, float* to) {
  __builtin_memcpy(to, &x, sizeof x);
}

template <class Pack>
constexpr std::int32_t lanes_of = sizeof(Pack) / sizeof(float);

/// The products of a pack of rows and columns [first, first + count) of a chunk, in four parts.
template <class Pack, int vectors, int stride, int count>
GEM_INLINE void add_chunk(const float* at, const float* const* x, std::int32_t first, Pack (&total)[vectors]) {
  Pack part[vectors][4] = {};
  for (std::int32_t i = 0; i < part_columns; ++i)
    for (std::int32_t p = 0; p < 4; ++p) {
      const std::int32_t k = part_columns * p + i;
      if (k >= count) continue;
      const Pack column = load_as<Pack>(at + stride * k);
      for (int v = 0; v < vectors; ++v) part[v][p] += column * x[v][first + k];
    }
  for (int v = 0; v < vectors; ++v) total[v] += (part[v][0] + part[v][1]) + (part[v][2] + part[v][3]);
}

/// A pack of rows of a panel times every vector: chunk by chunk of its columns.
template <class Pack, int vectors, int stride>
GEM_INLINE void multiply_panel(const float* panel, std::int32_t columns, const float* const* x,
                               Pack (&total)[vectors]) {
  std::int32_t k = 0;
  for (; k + chunk_columns <= columns; k += chunk_columns)
    add_chunk<Pack, vectors, stride, chunk_columns>(panel + stride * k, x, k, total);
  const float* const rest = panel + stride * k;
  switch ((columns - k) / motions) {
    case 1:
      return add_chunk<Pack, vectors, stride, 3>(rest, x, k, total);
    case 2:
      return add_chunk<Pack, vectors, stride, 6>(rest, x, k, total);
    case 3:
      return add_chunk<Pack, vectors, stride, 9>(rest, x, k, total);
    case 4:
      return add_chunk<Pack, vectors, stride, 12>(rest, x, k, total);
    case 5:
      return add_chunk<Pack, vectors, stride, 15>(rest, x, k, total);
    case 6:
      return add_chunk<Pack, vectors, stride, 18>(rest, x, k, total);
    case 7:
      return add_chunk<Pack, vectors, stride, 21>(rest, x, k, total);
    default:
      return;
  }
}

/// A matrix times every vector. `Wide`: FloatPack, or FloatWide in a GEM_WIDE function.
template <class Wide, int vectors>
GEM_INLINE void multiply(const float* matrix, std::int32_t rows, std::int32_t columns, const float* const* x,
                         float* const* result) {
  std::int32_t r = 0;
  for (; r + panel_rows <= rows; r += panel_rows)
    for (std::int32_t part = 0; part < panel_rows; part += lanes_of<Wide>) {
      Wide sum[vectors] = {};
      multiply_panel<Wide, vectors, panel_rows>(matrix + static_cast<std::size_t>(r) * columns + part, columns, x, sum);
      for (int v = 0; v < vectors; ++v) store_as(sum[v], result[v] + r + part);
    }
  if (r == rows) return;
  FloatPack sum[vectors] = {};
  multiply_panel<FloatPack, vectors, float_lanes>(matrix + static_cast<std::size_t>(r) * columns, columns, x, sum);
  for (int v = 0; v < vectors; ++v) store_as(sum[v], result[v] + r);
}

}  // namespace gem
