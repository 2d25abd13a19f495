// Factor of the equations of an island on a device: FrontFactor, level by level, with the same sums in the same order.
// Each block factors its branch, then all factor the trunk.
#pragma once

#include "gem/engine/solver/splitting/device/device_fronts.h"
#include "gem/engine/solver/splitting/device/device_own_blocks.h"
#include "gem/engine/solver/splitting/device/device_point_fields.h"

namespace gem {

template <class Team>
class DeviceFactor {
 public:
  GEM_DEVICE DeviceFactor(const Team& team, const TeamMemory& memory)
      : team_(team), part_(team.part()), v_(memory.part->view), p_(*memory.part), own_blocks_(memory) {}

  /// Sets where the block of each pair stands in the matrix.
  GEM_DEVICE void place_blocks() {
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      IslandPointPlace& at = v_.m.where[k];
      const IslandPointEnds ends = v_.m.ends[k];
      if (ends.a < 0 || ends.b < 0 || at.row_length < 0) return;
      const std::int32_t early = ends.a < ends.b ? ends.a : ends.b, late = ends.a < ends.b ? ends.b : ends.a;
      const IslandNode& f = v_.node_at(early);
      const std::int32_t row = row_in(v_, f, late), column = 3 * (early - f.own);
      at.row_length = row < f.own_rows() ? f.own_rows() : f.other_rows();
      at.block = row < f.own_rows() ? f.own_block() + row + std::int64_t{column} * f.own_rows()
                                    : f.joined() + row - f.own_rows() + std::int64_t{column} * f.other_rows();
    });
    team_.sync();
  }

  /// Factors the matrix with the stiffness of the points.
  GEM_DEVICE void factor() {
    clear(part_, p_.branch);
    clear(team_, p_.trunk);
    team_.sync();
    each_of(team_, 0, v_.bodies, [&](std::int32_t place) { set_diagonal(place); });
    each_of(team_, 0, v_.points, [&](std::int32_t k) { set_pair(k); });
    team_.sync();
    for (std::int32_t level = p_.branch.levels; level-- > 0;) factor_level(part_, p_.branch, level);
    if (p_.trunk.levels > 0) team_.sync();
    for (std::int32_t level = p_.trunk.levels; level-- > 0;) factor_level(team_, p_.trunk, level);
  }

 private:
  using Part = typename Team::Part;
  static constexpr int warp_size = Team::Warp::size;

  template <class Some>
  GEM_DEVICE void clear(const Some& some, const TreePart& part) const {
    float* const from = v_.m.numbers + part.first_number;
    for (std::int64_t k = some.rank(); k < part.numbers; k += some.size()) from[k] = 0.0F;
  }

  GEM_DEVICE void set_diagonal(std::int32_t place) const {
    const ScaledBody& b = v_.m.scaled[place];
    float block[9] = {b.mass, 0.0F, 0.0F, 0.0F, b.mass, 0.0F, 0.0F, 0.0F, b.inertia};
    const BodyRecords e = v_.m.records[place];
    for (std::int32_t k = 0; k < e.count; ++k) {
      const SplitPoint<float> q = load_point<SplitPoint<float>>(v_, v_.m.point_of[e.first + k]);
      const bool as_b = k < e.as_b;
      float n[3], t[3];
      for (int c = 0; c < 3; ++c) {
        n[c] = as_b ? q.n_b[c] : q.n_a[c];
        t[c] = as_b ? q.t_b[c] : q.t_a[c];
      }
      add_block(block, q, n, t, n, t);
    }
    const IslandNode& f = v_.node_at(place);
    const std::int32_t at = 3 * (place - f.own);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        v_.m.numbers[f.own_block() + at + r + std::int64_t{at + c} * f.own_rows()] = block[3 * r + c];
  }

  GEM_DEVICE void set_pair(std::int32_t k) const {
    const IslandPointPlace at = v_.m.where[k];
    if (at.block < 0) return;
    const IslandPointEnds ends = v_.m.ends[k];
    float block[9] = {};
    for (std::int32_t point = k; point >= 0; point = v_.m.where[point].next) {
      const SplitPoint<float> q = load_point<SplitPoint<float>>(v_, point);
      if (ends.a > ends.b)
        add_block(block, q, q.n_a, q.t_a, q.n_b, q.t_b);
      else
        add_block(block, q, q.n_b, q.t_b, q.n_a, q.t_a);
    }
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) v_.m.numbers[at.block + r + std::int64_t{c} * at.row_length] = block[3 * r + c];
  }

  GEM_DEVICE static void add_block(float* to, const SplitPoint<float>& q, const float* n, const float* t,
                                   const float* m, const float* u) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) to[3 * r + c] += q.stiff_n * n[r] * m[c] + q.stiff_t * t[r] * u[c];
  }

  /// Calls work(node, rank, ranks) for the fronts of a level, each by some threads.
  template <class Some, class Work>
  GEM_DEVICE GEM_INLINE void each_front(const Some& some, std::int32_t first, std::int32_t last, Work&& work) const {
    std::int32_t ranks = 1;
    while (2 * ranks * (last - first) <= some.size()) ranks *= 2;
    for (std::int32_t id = first + some.rank() / ranks; id < last; id += some.size() / ranks)
      work(v_.m.node[id], some.rank() % ranks, ranks);
  }

  /// `some`: the threads of a block for a branch, those of all blocks for the trunk.
  template <class Some>
  GEM_DEVICE void factor_level(const Some& some, const TreePart& part, std::int32_t level) {
    const std::int32_t first = v_.m.level[part.level + level].node, last = v_.m.level[part.level + level + 1].node;
    for (int child = 0; child < 2; ++child) {
      each_front(some, first, last, [&](const IslandNode& f, std::int32_t rank, std::int32_t ranks) {
        if (f.child[child] >= 0) add_child(f, v_.m.node[f.child[child]], rank, ranks);
      });
      some.sync();
    }
    own_blocks_.invert(some, v_, first, last);
    some.sync();
    each_front(some, first, last,
               [&](const IslandNode& f, std::int32_t rank, std::int32_t ranks) { set_forth(f, rank, ranks); });
    some.sync();
    each_front(some, first, last,
               [&](const IslandNode& f, std::int32_t rank, std::int32_t ranks) { set_complement(f, rank, ranks); });
    const IslandLevel begin = v_.m.level[part.level + level], end = v_.m.level[part.level + level + 1];
    each_tile(some, v_.m.forth_tile, begin.forth_tile, end.forth_tile,
              [&](const SolveTile& tile, int lane) { fill_forth(tile, lane); });
    each_tile(some, v_.m.back_tile, begin.back_tile, end.back_tile,
              [&](const SolveTile& tile, int lane) { fill_back(tile, lane); });
    some.sync();
  }

  /// Adds the complement of a child, the part on and below the diagonal.
  GEM_DEVICE void add_child(const IslandNode& f, const IslandNode& child, std::int32_t rank, std::int32_t ranks) const {
    const std::int32_t from_rows = child.other_rows(), own = f.own_rows(), other = f.other_rows();
    const float* const from = v_.m.numbers + child.complement();
    const std::int32_t* const row_above = v_.m.row_above + child.first_other;
    for (std::int32_t k = rank; k < from_rows * from_rows; k += ranks) {
      const std::int32_t r = k % from_rows, c = k / from_rows;
      if (r < c) continue;
      const std::int32_t row = row_above[r / 3] + r % 3, column = row_above[c / 3] + c % 3;
      std::int64_t to = 0;
      if (column >= own)
        to = f.complement() + row - own + std::int64_t{column - own} * other;
      else if (row >= own)
        to = f.joined() + row - own + std::int64_t{column} * other;
      else
        to = f.own_block() + row + std::int64_t{column} * own;
      v_.m.numbers[to] += from[k];
    }
  }

  /// Numbers that a thread loads together, to hide the latency of memory.
  static constexpr int together = 6;

  /// `sum` plus (`sign` 1) or minus (-1) the products of two rows, in the order of the columns.
  GEM_DEVICE GEM_INLINE static float sum_products(float sum, float sign, const float* x, std::int64_t x_stride,
                                                  const float* y, std::int64_t y_stride, std::int32_t columns) {
    std::int32_t k = 0;
    for (; k + together <= columns; k += together) {
      float of_x[together], of_y[together];
      for (int i = 0; i < together; ++i) {
        of_x[i] = x[(k + i) * x_stride];
        of_y[i] = y[(k + i) * y_stride];
      }
      for (int i = 0; i < together; ++i) sum += sign * (of_x[i] * of_y[i]);
    }
    for (; k < columns; ++k) sum += sign * (x[k * x_stride] * y[k * y_stride]);
    return sum;
  }

  /// H = -C A^-1
  GEM_DEVICE void set_forth(const IslandNode& f, std::int32_t rank, std::int32_t ranks) const {
    const std::int32_t own = f.own_rows(), other = f.other_rows();
    const float *const inverse = v_.m.numbers + f.own_block(), *const c = v_.m.numbers + f.joined();
    float* const h = v_.m.numbers + f.forth();
    for (std::int32_t e = rank; e < own * other; e += ranks) {
      const std::int32_t r = e % other, j = e / other;
      h[e] = sum_products(0.0F, -1.0F, c + r, other, inverse + j, own, own);
    }
  }
  GEM_DEVICE void set_complement(const IslandNode& f, std::int32_t rank, std::int32_t ranks) const {
    const std::int32_t own = f.own_rows(), other = f.other_rows();
    const float *const h = v_.m.numbers + f.forth(), *const c = v_.m.numbers + f.joined();
    float* const to = v_.m.numbers + f.complement();
    for (std::int32_t e = rank; e < other * other; e += ranks) {
      const std::int32_t r = e % other, m = e / other;
      if (r >= m) to[e] = sum_products(to[e], 1.0F, h + r, other, c + m, other, own);
    }
  }

  template <class Some, class Work>
  GEM_DEVICE GEM_INLINE void each_tile(const Some& some, const SolveTile* tile, std::int32_t begin, std::int32_t end,
                                       Work&& work) const {
    for (std::int32_t k = begin + some.rank() / warp_size; k < end; k += some.size() / warp_size)
      work(tile[k], some.rank() % warp_size);
  }
  /// Calls take(row body, column body, row, column) for the numbers of a thread. All lanes make the same turns: with
  /// turns by lane nvcc 13.0 leaves the warp diverged at the next barrier, and the blocks of a cluster part for ever.
  template <class Take>
  GEM_DEVICE GEM_INLINE void each_number(const SolveTile& tile, int lane, Take&& take) const {
    const std::int32_t body = lane / tile.lanes, mine = lane % tile.lanes, all = tile.owns + tile.others;
    float* to = v_.m.numbers + tile.numbers + lane;
    for (std::int32_t first = 0; part_bodies * first < all; first += tile.lanes)
      for (std::int32_t i = 0; i < part_bodies; ++i)
        for (int e = 0; e < 9; ++e, to += warp_size) {
          const std::int32_t column = part_bodies * (first + mine) + i;
          if (body < tile.rows && column < all) *to = take(tile.first + body, column, e / 3, e % 3);
        }
  }
  GEM_DEVICE void fill_forth(const SolveTile& tile, int lane) const {
    const IslandNode& f = v_.m.node[v_.m.front[tile.first]];
    const float* const h = v_.m.numbers + f.forth();
    each_number(tile, lane, [&](std::int32_t slot, std::int32_t j, int r, int c) {
      return h[3 * (slot - f.first_other) + r + std::int64_t{3 * j + c} * f.other_rows()];
    });
  }
  GEM_DEVICE void fill_back(const SolveTile& tile, int lane) const {
    const IslandNode& f = v_.node_at(tile.first);
    const float *const inverse = v_.m.numbers + f.own_block(), *const h = v_.m.numbers + f.forth();
    each_number(tile, lane, [&](std::int32_t place, std::int32_t j, int r, int c) {
      const std::int32_t row = 3 * (place - f.own) + r;
      return j < tile.owns ? inverse[row + std::int64_t{3 * j + c} * f.own_rows()]
                           : h[3 * (j - tile.owns) + c + std::int64_t{row} * f.other_rows()];
    });
  }

  const Team& team_;
  const Part part_;
  const IslandView& v_;
  const PartCell& p_;
  const OwnBlocks own_blocks_;
};

}  // namespace gem
