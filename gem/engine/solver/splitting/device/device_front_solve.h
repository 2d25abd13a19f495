// Solution of the equations of an island on a device: FrontFactor::solve_first() and solve_both(), level by level, with
// the same sums in the same order. Each block goes forth through its branch, all go forth and back through the trunk,
// and each goes back through its branch.
#pragma once

#include "gem/engine/solver/splitting/device/device_team.h"
#include "gem/engine/solver/splitting/solve_tiles.h"

namespace gem {

template <class Team>
class FrontSolve {
 public:
  GEM_DEVICE FrontSolve(const Team& team, const TeamMemory& memory)
      : team_(team), part_(team.part()), warp_(part_.warp()), v_(memory.part->view), p_(*memory.part) {}

  /// Solves for `halves` (1: velocities, 2: with the repair), from `sum` to `solution`, and adds the solution to `now`.
  /// The sums of a part's own bodies were written by its threads. Ends without a barrier of the team.
  GEM_DEVICE void solve(int halves) { halves == 2 ? solve_halves<2>() : solve_halves<1>(); }

 private:
  using Part = typename Team::Part;
  using Warp = typename Team::Warp;
  static_assert(Warp::size >= 4);

  /// Numbers of a body's rows: three of velocity and three of repair.
  template <int halves>
  struct Rows {
    float number[halves][3];
  };

  template <int halves>
  GEM_DEVICE void solve_halves() {
    forth_all<halves>(part_, p_.branch);
    if (p_.trunk.levels > 0) {
      team_.sync();
      forth_all<halves>(team_, p_.trunk);
      back_all<halves>(team_, p_.trunk);
    }
    back_all<halves>(part_, p_.branch);
  }

  /// `some`: the threads of a block for a branch, those of all blocks for the trunk.
  template <int halves, class Some>
  GEM_DEVICE void forth_all(const Some& some, const TreePart& part) {
    if (part.levels == 0) return;
    IslandLevel end = v_.m.level[part.level + part.levels];
    for (std::int32_t level = part.levels; level-- > 0;) {
      const IslandLevel begin = v_.m.level[part.level + level];
      each_of(some, halves * begin.own, halves * end.own,
              [&](std::int32_t k) { add_parts(v_.m.own_place[k / halves], k % halves); });
      some.sync();
      if (begin.forth_tile < end.forth_tile) {
        each_tile(some, v_.m.forth_tile, begin.forth_tile, end.forth_tile,
                  [&](const SolveTile& tile) { forth<halves>(tile); });
        some.sync();
      }
      end = begin;
    }
  }
  template <int halves, class Some>
  GEM_DEVICE void back_all(const Some& some, const TreePart& part) {
    if (part.levels == 0) return;
    IslandLevel begin = v_.m.level[part.level];
    for (std::int32_t level = 0; level < part.levels; ++level) {
      const IslandLevel end = v_.m.level[part.level + level + 1];
      each_tile(some, v_.m.back_tile, begin.back_tile, end.back_tile,
                [&](const SolveTile& tile) { back<halves>(tile); });
      some.sync();
      begin = end;
    }
  }

  template <class Some, class Work>
  GEM_DEVICE GEM_INLINE void each_tile(const Some& some, const SolveTile* tile, std::int32_t begin, std::int32_t end,
                                       Work&& work) const {
    for (std::int32_t k = begin + some.rank() / Warp::size; k < end; k += some.size() / Warp::size) {
      const SolveTile own = tile[k];
      work(own);
    }
  }

  /// Adds what the fronts below a body give to it.
  GEM_DEVICE void add_parts(std::int32_t place, int half) {
    const std::int32_t* const slot = v_.m.sorted + v_.m.first_in[place];
    const std::int32_t count = v_.m.parts_in[place];
    if (count == 0) return;
    constexpr int together = 8;
    FloatQuad sum = v_.m.sum[2 * place + half];
    for (std::int32_t k = 0; k < count; k += together) {
      FloatQuad some[together];
      for (int j = 0; j < together; ++j) some[j] = k + j < count ? v_.m.product[2 * slot[k + j] + half] : FloatQuad{};
      for (int j = 0; j < together; ++j)
        if (k + j < count)
          for (int c = 0; c < 3; ++c) sum.part[c] += some[j].part[c];
    }
    v_.m.sum[2 * place + half] = sum;
  }

  /// The rows of others in H times the own numbers.
  template <int halves>
  GEM_DEVICE GEM_INLINE void forth(const SolveTile& tile) {
    const Rows<halves> total = rows_times<halves>(tile, [&](std::int32_t j) { return v_.m.sum + 2 * (tile.own + j); });
    each_result<halves>(tile, total, [&](std::int32_t slot, int half, const FloatQuad& result) {
      v_.m.product[2 * slot + half] = result;
    });
  }

  /// The rows of own bodies in G times the front's numbers.
  template <int halves>
  GEM_DEVICE GEM_INLINE void back(const SolveTile& tile) {
    const Rows<halves> total = rows_times<halves>(tile, [&](std::int32_t j) {
      return j < tile.owns ? v_.m.sum + 2 * (tile.own + j)
                           : v_.m.solution + 2 * v_.m.other[tile.first_other + j - tile.owns];
    });
    each_result<halves>(tile, total, [&](std::int32_t place, int half, const FloatQuad& result) {
      v_.m.solution[2 * place + half] = result;
      FloatQuad& now = v_.m.now[2 * place + half];
      for (int c = 0; c < 3; ++c) now.part[c] += result.part[c];
    });
  }

  /// Calls take(row body, half, numbers), from one thread for each half of each body.
  template <int halves, class Take>
  GEM_DEVICE GEM_INLINE void each_result(const SolveTile& tile, const Rows<halves>& total, Take&& take) const {
    const std::int32_t lane = warp_.rank() & (tile.lanes - 1), body = warp_.rank() >> tile.shift;
    if (body >= tile.rows || lane >= halves) return;
    FloatQuad result{};
    for (int c = 0; c < 3; ++c) result.part[c] = lane == 0 ? total.number[0][c] : total.number[halves - 1][c];
    take(tile.first + body, lane, result);
  }

  /// The rows of a tile times a vector. `x`: the numbers of column body j. All threads of the warp take part, and all
  /// lanes of a body get its sums.
  template <int halves, class X>
  GEM_DEVICE GEM_INLINE Rows<halves> rows_times(const SolveTile& tile, X&& x) const {
    const std::int32_t lane = warp_.rank() & (tile.lanes - 1), all = tile.owns + tile.others;
    const bool has_row = (warp_.rank() >> tile.shift) < tile.rows;
    const float* numbers = v_.m.numbers + tile.numbers + warp_.rank();
    Rows<halves> total{};
    for (std::int32_t first = 0; part_bodies * first < all; first += tile.lanes) {
      const std::int32_t j = part_bodies * (first + lane);
      Rows<halves> part{};
      if (has_row && j < all) {
        float a[tile_numbers];
        for (int e = 0; e < tile_numbers; ++e) a[e] = numbers[e * Warp::size];
        FloatQuad of_x[part_bodies][halves];
        for (int i = 0; i < part_bodies; ++i) {
          const FloatQuad* const from = x(j + i < all ? j + i : j);
          for (int h = 0; h < halves; ++h) of_x[i][h] = from[h];
        }
        for (int i = 0; i < part_bodies; ++i)
          if (j + i < all)
            for (int c = 0; c < 3; ++c)
              for (int h = 0; h < halves; ++h)
                for (int r = 0; r < 3; ++r) part.number[h][r] += a[9 * i + 3 * r + c] * of_x[i][h].part[c];
      }
      numbers += tile_numbers * Warp::size;
      add_chunks<halves>(tile.lanes, all - part_bodies * first, part, total);
    }
    return total;
  }

  /// Adds the chunks of the lanes of a body: four lanes each, in the order of the chunks. `columns`: bodies from the
  /// first lane on.
  template <int halves>
  GEM_DEVICE GEM_INLINE void add_chunks(std::int32_t lanes, std::int32_t columns, Rows<halves>& part,
                                        Rows<halves>& total) const {
    for (int step = 1; step < 4; step *= 2)
      for (int h = 0; h < halves; ++h)
        for (int r = 0; r < 3; ++r) part.number[h][r] += warp_.partner(part.number[h][r], step);
    const std::int32_t from = warp_.rank() & ~(lanes - 1);
    for (std::int32_t k = 0; 4 * k < lanes; ++k)  // the numbers side by side, since each takes long
      for (int h = 0; h < halves; ++h)
        for (int r = 0; r < 3; ++r) {
          const float chunk = warp_.from(part.number[h][r], from + 4 * k);
          if (chunk_bodies * k < columns) total.number[h][r] += chunk;
        }
  }

  const Team& team_;
  const Part part_;
  const Warp warp_;
  const IslandView& v_;
  const PartCell& p_;
};

}  // namespace gem
