// Sparse factor of the equations of an island, in blocks of 3 x 3 (the three motions of a body): K = L D L^T.
//
// Bodies are numbered in the order of elimination. L has unit blocks on the diagonal; D has symmetric 3 x 3 blocks, of
// which the inverse is kept. Every sum has a fixed order, so the same equations give the same bits.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gem::bench {

class BodyFactor {
 public:
  static constexpr int block = 9;        // numbers of a block
  static constexpr int row_numbers = 8;  // of a body in the unknowns of the solve

  /// Finds the blocks of the factor for `bodies` bodies and the contacts `pairs` (lower number first).
  void analyse(std::int32_t bodies, std::span<const std::pair<std::int32_t, std::int32_t>> pairs);
  /// Zeroes all blocks and sets the diagonal to one.
  void reset();
  /// The block on the diagonal, row by row.
  float* diagonal(std::int32_t body) { return &diagonal_[block * body]; }
  /// The block of row `row` and column `column` < row, row by row.
  float* below(std::int32_t row, std::int32_t column);
  void factor();
  /// Solve K x = b in place, for rows of eight floats a body: three numbers and a zero in each half. solve_first()
  /// leaves the second half alone, solve_both() solves for both halves.
  void solve_first(float* x) const;
  void solve_both(float* x) const;

  std::int32_t bodies() const { return static_cast<std::int32_t>(first_.size()) - 1; }
  std::size_t blocks() const { return row_.size(); }

 private:
  template <class Numbers>
  void solve(float* x) const;

  std::vector<std::int32_t> first_;  // per column: its first block; the end behind the last
  std::vector<std::int32_t> row_;    // per block, ascending in a column
  std::vector<float> lower_;         // blocks below the diagonal, row by row; padded by three numbers
  std::vector<float> diagonal_, inverse_;
  // memory of analyse()
  std::vector<std::int32_t> mark_, next_of_parent_, first_child_, own_first_, own_row_;
};

}  // namespace gem::bench
