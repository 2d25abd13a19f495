// Factor and solution of the equations of an island on a device: FrontFactor, level by level, with the same sums in the
// same order.
#pragma once

#include "gem/engine/solver/splitting/device_fronts.h"

namespace gem {

template <class Team>
class DeviceFactor {
 public:
  GEM_DEVICE DeviceFactor(const Team& team, const IslandView& view, const SolverEntry* entry)
      : team_(team), v_(view), entry_(entry) {}

  /// Sets where the block of each pair stands in the matrix.
  GEM_DEVICE void place_blocks() {
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      IslandPointPlace& at = v_.m.where[k];
      if (at.a < 0 || at.b < 0 || at.row_length < 0) return;
      const std::int32_t early = at.a < at.b ? at.a : at.b, late = at.a < at.b ? at.b : at.a;
      const IslandNode& f = v_.node_at(early);
      const std::int32_t row = row_in(v_, f, late), column = 3 * (early - f.own);
      at.row_length = row < f.own_rows() ? f.own_rows() : f.other_rows();
      at.block = row < f.own_rows() ? f.back() + row + std::int64_t{column} * f.own_rows()
                                    : f.joined() + row - f.own_rows() + std::int64_t{column} * f.other_rows();
    });
    team_.sync();
  }

  /// Factors the matrix with the stiffness of the points.
  GEM_DEVICE void factor(std::uint64_t all_numbers) {
    for (std::uint64_t k = team_.rank(); k < all_numbers; k += team_.size()) v_.m.numbers[k] = 0.0F;
    team_.sync();
    each_of(team_, 0, v_.bodies, [&](std::int32_t p) { set_diagonal(p); });
    each_of(team_, 0, v_.points, [&](std::int32_t k) { set_pair(v_.m.where[k], k); });
    team_.sync();
    for (std::int32_t level = v_.levels; level-- > 0;) factor_level(v_.first_node(level), v_.first_node(level + 1));
  }

  /// Solves for `halves` (1: velocities, 2: with the repair): from `sum` to `solution`.
  GEM_DEVICE void solve(int halves) {
    for (std::int32_t level = v_.levels; level-- > 0;) {
      each_number(1, v_.first_own(level), v_.first_own(level + 1), halves,
                  [&](std::int32_t k, int half, int c) { add_parts(v_.m.own_place[k], half, c); });
      team_.sync();
      if (level == 0) break;
      each_number(Team::Lanes::size, v_.first_slot(level), v_.first_slot(level + 1), halves,
                  [&](std::int32_t t, int half, int c) { forth(t, half, c); });
      team_.sync();
    }
    for (std::int32_t level = 0; level < v_.levels; ++level) {
      each_number(Team::Lanes::size, v_.first_own(level), v_.first_own(level + 1), halves,
                  [&](std::int32_t k, int half, int c) { back(v_.m.own_place[k], half, c); });
      team_.sync();
    }
  }

 private:
  /// Numbers that a thread loads together, to hide the latency of memory.
  static constexpr int together = 8;

  /// Calls work(k, half, component) for the numbers of a range; `lanes` neighbouring threads share a number.
  template <class Work>
  GEM_DEVICE GEM_INLINE void each_number(int lanes, std::int32_t begin, std::int32_t end, int halves,
                                         Work&& work) const {
    const std::int32_t count = 3 * (end - begin);
    for (std::int32_t j = team_.rank() / lanes; j < halves * count; j += team_.size() / lanes) {
      const int half = j >= count ? 1 : 0;
      const std::int32_t k = j - half * count;
      work(begin + k / 3, half, k % 3);
    }
  }

  GEM_DEVICE void set_diagonal(std::int32_t place) {
    const ScaledBody& b = v_.m.scaled[place];
    float block[9] = {b.mass, 0.0F, 0.0F, 0.0F, b.mass, 0.0F, 0.0F, 0.0F, b.inertia};
    const SolverEntry& e = entry_[v_.m.member[v_.m.order[place]]];
    for (std::int32_t k = 0; k < e.count; ++k) {
      const SplitPoint<float>& q = v_.m.point[v_.m.point_of[e.place + k]];
      const bool as_b = k < e.as_b;
      const float *const n = as_b ? q.n_b : q.n_a, *const t = as_b ? q.t_b : q.t_a;
      add_block(block, q, n, t, n, t);
    }
    const IslandNode& f = v_.node_at(place);
    const std::int32_t at = 3 * (place - f.own);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        v_.m.numbers[f.back() + at + r + std::int64_t{at + c} * f.own_rows()] = block[3 * r + c];
  }

  GEM_DEVICE void set_pair(const IslandPointPlace& at, std::int32_t k) {
    if (at.block < 0) return;
    float block[9] = {};
    for (std::int32_t point = k; point >= 0; point = point == k ? at.second : -1) {
      const SplitPoint<float>& q = v_.m.point[point];
      if (at.a > at.b)
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
  template <class Work>
  GEM_DEVICE GEM_INLINE void each_front(std::int32_t first, std::int32_t last, Work&& work) const {
    std::int32_t ranks = 1;
    while (2 * ranks * (last - first) <= team_.size()) ranks *= 2;
    for (std::int32_t id = first + team_.rank() / ranks; id < last; id += team_.size() / ranks)
      work(v_.m.node[id], team_.rank() % ranks, ranks);
  }

  GEM_DEVICE void factor_level(std::int32_t first, std::int32_t last) {
    for (int child = 0; child < 2; ++child) {
      each_front(first, last, [&](const IslandNode& f, std::int32_t rank, std::int32_t ranks) {
        if (f.child >= 0) add_child(f, v_.m.node[f.child + child], rank, ranks);
      });
      team_.sync();
    }
    each_front(first, last, [&](const IslandNode& f, std::int32_t rank, std::int32_t ranks) {
      float* const a = v_.m.numbers + f.back();
      const std::int32_t rows = f.own_rows();
      for (std::int32_t k = rank; k < rows * rows; k += ranks)
        if (k % rows < k / rows) a[k] = a[k / rows + std::int64_t{k % rows} * rows];
    });
    team_.sync();
    invert_own(first, last);
    team_.sync();
    each_front(first, last,
               [&](const IslandNode& f, std::int32_t rank, std::int32_t ranks) { set_forth(f, rank, ranks); });
    team_.sync();
    each_front(first, last, [&](const IslandNode& f, std::int32_t rank, std::int32_t ranks) {
      set_back(f, rank, ranks);
      set_complement(f, rank, ranks);
    });
    team_.sync();
  }

  /// Adds the complement of a child, the part on and below the diagonal.
  GEM_DEVICE void add_child(const IslandNode& f, const IslandNode& child, std::int32_t rank, std::int32_t ranks) {
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
        to = f.back() + row + std::int64_t{column} * own;
      v_.m.numbers[to] += from[k];
    }
  }

  /// Replaces the own blocks of a level by their inverses (Gauss and Jordan, in place). Each part of the team takes
  /// some fronts.
  GEM_DEVICE void invert_own(std::int32_t first, std::int32_t last) {
    const auto part = team_.part();
    const std::int32_t parts = team_.parts(), mine = first + team_.part_index();
    std::int32_t most = 0, fronts = 0, ranks = 1;
    for (std::int32_t id = mine; id < last; id += parts, ++fronts) {
      const std::int32_t rows = v_.m.node[id].own_rows();
      most = rows > most ? rows : most;
    }
    if (fronts == 0) return;
    while (2 * ranks * fronts <= part.size()) ranks *= 2;
    const std::int32_t rank = part.rank() % ranks, step = parts * (part.size() / ranks);
    const std::int32_t begin = mine + parts * (part.rank() / ranks);
    for (std::int32_t k = 0; k < most; ++k) {
      for (std::int32_t id = begin; id < last; id += step) take_pivot(v_.m.node[id], k, rank, ranks);
      part.sync();
      for (std::int32_t id = begin; id < last; id += step) eliminate(v_.m.node[id], k, rank, ranks);
      part.sync();
    }
  }
  GEM_DEVICE void take_pivot(const IslandNode& f, std::int32_t k, std::int32_t rank, std::int32_t ranks) {
    const std::int32_t rows = f.own_rows();
    if (k >= rows) return;
    const float* const a = v_.m.numbers + f.back();
    const float inverse = 1.0F / a[k + std::int64_t{k} * rows];
    for (std::int32_t r = rank; r < rows; r += ranks) {
      pivot(f, r) = r == k ? 0.0F : a[r + std::int64_t{k} * rows];
      share(f, r) = (r == k ? 1.0F : a[k + std::int64_t{r} * rows]) * inverse;
    }
  }
  GEM_DEVICE void eliminate(const IslandNode& f, std::int32_t k, std::int32_t rank, std::int32_t ranks) {
    const std::int32_t rows = f.own_rows();
    if (k >= rows) return;
    float* const a = v_.m.numbers + f.back();
    for (std::int32_t e = rank; e < rows * rows; e += ranks) {
      const std::int32_t r = e % rows, c = e / rows;
      a[e] = r == k ? share(f, c) : (c == k ? 0.0F : a[e]) - pivot(f, r) * share(f, c);
    }
  }
  GEM_DEVICE float& pivot(const IslandNode& f, std::int32_t r) const { return v_.m.pivot[f.own + r / 3].part[r % 3]; }
  GEM_DEVICE float& share(const IslandNode& f, std::int32_t r) const { return v_.m.share[f.own + r / 3].part[r % 3]; }

  /// `sum` plus (`sign` 1) or minus (-1) the products of two rows, in the order of the columns.
  GEM_DEVICE GEM_INLINE static float sum_products(float sum, float sign, const float* x, std::int64_t x_stride,
                                                  const float* y, std::int64_t y_stride, std::int32_t columns) {
    for (std::int32_t k = 0; k < columns; k += together) {
      float of_x[together], of_y[together];
      for (int i = 0; i < together; ++i) {
        of_x[i] = k + i < columns ? x[(k + i) * x_stride] : 0.0F;
        of_y[i] = k + i < columns ? y[(k + i) * y_stride] : 0.0F;
      }
      for (int i = 0; i < together; ++i)
        if (k + i < columns) sum += sign * (of_x[i] * of_y[i]);
    }
    return sum;
  }

  /// H = -C A^-1
  GEM_DEVICE void set_forth(const IslandNode& f, std::int32_t rank, std::int32_t ranks) {
    const std::int32_t own = f.own_rows(), other = f.other_rows();
    const float *const inverse = v_.m.numbers + f.back(), *const c = v_.m.numbers + f.joined();
    float* const h = v_.m.numbers + f.forth();
    for (std::int32_t e = rank; e < own * other; e += ranks) {
      const std::int32_t r = e % other, j = e / other;
      h[e] = sum_products(0.0F, -1.0F, c + r, other, inverse + j, own, own);
    }
  }
  GEM_DEVICE void set_back(const IslandNode& f, std::int32_t rank, std::int32_t ranks) {
    const std::int32_t own = f.own_rows(), other = f.other_rows();
    const float* const h = v_.m.numbers + f.forth();
    float* const g = v_.m.numbers + f.back() + std::int64_t{own} * own;
    for (std::int32_t e = rank; e < own * other; e += ranks) g[e] = h[e / own + std::int64_t{e % own} * other];
  }
  GEM_DEVICE void set_complement(const IslandNode& f, std::int32_t rank, std::int32_t ranks) {
    const std::int32_t own = f.own_rows(), other = f.other_rows();
    const float *const h = v_.m.numbers + f.forth(), *const c = v_.m.numbers + f.joined();
    float* const to = v_.m.numbers + f.complement();
    for (std::int32_t e = rank; e < other * other; e += ranks) {
      const std::int32_t r = e % other, m = e / other;
      if (r < m) continue;
      to[e] = sum_products(to[e], 1.0F, h + r, other, c + m, other, own);
    }
  }

  /// Adds what the fronts below a body give to it.
  GEM_DEVICE void add_parts(std::int32_t place, int half, int c) {
    const std::int32_t* const slot = v_.m.sorted + v_.m.first_in[place];
    const std::int32_t count = v_.m.parts_in[place];
    float sum = v_.m.sum[2 * place + half].part[c];
    for (std::int32_t k = 0; k < count; k += together) {
      float some[together];
      for (int j = 0; j < together; ++j) some[j] = k + j < count ? v_.m.product[2 * slot[k + j] + half].part[c] : 0.0F;
      for (int j = 0; j < together; ++j)
        if (k + j < count) sum += some[j];
    }
    v_.m.sum[2 * place + half].part[c] = sum;
  }

  /// Row `c` of another body in H times the own numbers.
  GEM_DEVICE void forth(std::int32_t slot, int half, int c) {
    const IslandNode& f = v_.m.node[v_.m.front[slot]];
    const FloatQuad* const x = v_.m.sum + 2 * f.own + half;
    const float sum = row_times(v_.m.numbers + f.forth() + 3 * (slot - f.first_other) + c, f.other_rows(), f.own_rows(),
                                [&](std::int32_t k) { return x[2 * (k / 3)].part[k % 3]; });
    if (team_.lanes().rank() == 0) v_.m.product[2 * slot + half].part[c] = sum;
  }

  /// Row `c` of an own body in G times the front's numbers.
  GEM_DEVICE void back(std::int32_t place, int half, int c) {
    const IslandNode& f = v_.node_at(place);
    const std::int32_t own = f.end - f.own;
    const FloatQuad* const x = v_.m.sum + 2 * f.own + half;
    const std::int32_t* const other = v_.m.other + f.first_other;
    const float sum = row_times(v_.m.numbers + f.back() + 3 * (place - f.own) + c, f.own_rows(),
                                f.own_rows() + f.other_rows(), [&](std::int32_t k) {
                                  const std::int32_t body = k / 3;
                                  return body < own ? x[2 * body].part[k % 3]
                                                    : v_.m.solution[2 * other[body - own] + half].part[k % 3];
                                });
    if (team_.lanes().rank() == 0) v_.m.solution[2 * place + half].part[c] = sum;
  }

  /// A row of a matrix times a vector, summed in four parts: column k in part k mod 4. Each lane sums some parts.
  /// `row`: its first number; `stride`: from column to column; `x`: number k of the vector. All lanes get the sum.
  template <class X>
  GEM_DEVICE GEM_INLINE float row_times(const float* row, std::int32_t stride, std::int32_t columns, X&& x) const {
    const auto lanes = team_.lanes();
    constexpr int size = Team::Lanes::size, own_parts = 4 / size;
    static_assert(size == 1 || size == 2 || size == 4);
    float part[own_parts];
    for (int j = 0; j < own_parts; ++j) {
      float sum = 0.0F;
      for (std::int32_t first = lanes.rank() + j * size; first < columns; first += 4 * together) {
        float number[together], of_x[together];
        for (int i = 0; i < together; ++i) {
          const std::int32_t k = first + 4 * i;
          number[i] = k < columns ? row[static_cast<std::int64_t>(k) * stride] : 0.0F;
          of_x[i] = k < columns ? x(k) : 0.0F;
        }
        for (int i = 0; i < together; ++i)
          if (first + 4 * i < columns) sum += number[i] * of_x[i];
      }
      part[j] = sum;
    }
    if constexpr (size == 1) return (part[0] + part[1]) + (part[2] + part[3]);
    for (float& sum : part) sum += static_cast<float>(lanes.partner(static_cast<double>(sum), 1));
    if constexpr (size == 2) return part[0] + part[1];
    return part[0] + static_cast<float>(lanes.partner(static_cast<double>(part[0]), 2));
  }

  const Team& team_;
  const IslandView& v_;
  const SolverEntry* entry_;
};

}  // namespace gem
