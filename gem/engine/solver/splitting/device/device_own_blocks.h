// Inverts the own blocks of the fronts of a level (FrontFactor::invert_own), in shared memory where they fit.
#pragma once

#include "gem/engine/solver/splitting/device/device_team.h"

namespace gem {

class OwnBlocks {
 public:
  GEM_DEVICE explicit OwnBlocks(const TeamMemory& memory) : memory_(memory) {}

  /// Replaces the own blocks of nodes [first, last) by their inverses (Gauss and Jordan, in place); above the diagonal
  /// they are not set yet. Each part of the team takes some of them. A barrier of the team has to follow.
  template <class Team>
  GEM_DEVICE void invert(const Team& team, const IslandView& v, std::int32_t first, std::int32_t last) const {
    const auto part = team.part();
    const std::int32_t step = team.parts();
    for (std::int32_t id = first + team.part_index(); id < last;) {
      // as many as fit
      std::int32_t count = 0, size = 0, most = 0;
      for (std::int32_t k = id; k < last && count < part.size(); k += step, ++count) {
        const std::int32_t rows = v.m.node[k].own_rows(), more = size_of(rows);
        if (count > 0 && size + more > memory_.scratch_size) break;
        size += more;
        most = rows > most ? rows : most;
      }
      invert_some(part, v, id, step, count, most, size <= memory_.scratch_size);
      id += count * step;
    }
  }

 private:
  /// A block under work: its numbers column by column, and two rows.
  struct Block {
    float *a, *pivot, *share;
    std::int32_t rows;
  };
  /// Not an even number, so that blocks begin at different banks.
  GEM_DEVICE static std::int32_t size_of(std::int32_t rows) { return (rows * (rows + 2)) | 1; }

  template <class Part>
  GEM_DEVICE void invert_some(const Part& part, const IslandView& v, std::int32_t id, std::int32_t step,
                              std::int32_t count, std::int32_t most, bool shared) const {
    std::int32_t ranks = 1;
    while (2 * ranks * count <= part.size()) ranks *= 2;
    const std::int32_t mine = part.rank() / ranks, rank = part.rank() % ranks;
    Block b{nullptr, nullptr, nullptr, 0};
    float* home = nullptr;
    if (mine < count) {
      const IslandNode& f = v.m.node[id + mine * step];
      std::int32_t before = 0;
      for (std::int32_t k = 0; k < mine; ++k) before += size_of(v.m.node[id + k * step].own_rows());
      home = v.m.numbers + f.own_block();
      b.rows = f.own_rows();
      b.a = shared ? memory_.scratch + before : home;
      b.pivot = shared ? b.a + b.rows * b.rows : v.m.pivot + 3 * f.own;
      b.share = shared ? b.pivot + b.rows : v.m.share + 3 * f.own;
      for (std::int32_t e = rank; e < b.rows * b.rows; e += ranks) {
        const std::int32_t r = e % b.rows, c = e / b.rows;
        if (shared)
          b.a[e] = r < c ? home[c + std::int64_t{r} * b.rows] : home[e];
        else if (r < c)
          b.a[e] = b.a[c + std::int64_t{r} * b.rows];
      }
    }
    part.sync();
    for (std::int32_t k = 0; k < most; ++k) {
      if (k < b.rows) take_pivot(b, k, rank, ranks);
      part.sync();
      if (k < b.rows) eliminate(b, k, rank, ranks);
      part.sync();
    }
    if (shared)
      for (std::int32_t e = rank; e < b.rows * b.rows; e += ranks) home[e] = b.a[e];
    part.sync();
  }
  GEM_DEVICE static void take_pivot(const Block& b, std::int32_t k, std::int32_t rank, std::int32_t ranks) {
    const float inverse = 1.0F / b.a[k + k * b.rows];
    for (std::int32_t r = rank; r < b.rows; r += ranks) {
      b.pivot[r] = r == k ? 0.0F : b.a[r + k * b.rows];
      b.share[r] = (r == k ? 1.0F : b.a[k + r * b.rows]) * inverse;
    }
  }
  GEM_DEVICE static void eliminate(const Block& b, std::int32_t k, std::int32_t rank, std::int32_t ranks) {
    std::int32_t r = rank % b.rows, c = rank / b.rows;
    const std::int32_t down = ranks % b.rows, right = ranks / b.rows;
    for (std::int32_t e = rank; e < b.rows * b.rows; e += ranks) {
      b.a[e] = r == k ? b.share[c] : (c == k ? 0.0F : b.a[e]) - b.pivot[r] * b.share[c];
      r += down;
      c += right;
      if (r >= b.rows) {
        r -= b.rows;
        ++c;
      }
    }
  }

  const TeamMemory& memory_;
};

}  // namespace gem
