// Factor of the equations of an island by dense fronts, and their solution.
//
// Every node of the elimination tree has a front: its own bodies, and the bodies of later nodes that its elimination
// joins. With A for its own rows and C for the rows of the others, below A, the front keeps
//
//     G = [A^-1, -A^-1 C^T]      own numbers from the front's: the way back, from the last node to the first
//     H = -C A^-1                others' numbers from the own: the way forth, from the first node to the last
//
// and hands C's complement to its parent (multifrontal method, Duff and Reid 1983). Each step of a node is one dense
// product. The matrix is symmetric and positive definite: no pivots are searched.
//
// All sums have a fixed order, the same on a device: a product adds chunks of the columns of eight bodies, one after
// another. A chunk has four parts of two bodies each, and is (part 0 + part 1) + (part 2 + part 3).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "gem/engine/solver/splitting/dissection.h"

namespace gem {

class FrontFactor {
 public:
  static constexpr std::int32_t block = 9;        // numbers of a block of 3 x 3: the motions of two bodies
  static constexpr std::int32_t row_numbers = 8;  // of a body in the unknowns of the solve

  /// Finds the fronts. `pairs`: bodies in contact, as places in the order of elimination, the earlier one first;
  /// ascending, each once.
  void analyse(const EliminationTree& tree, std::span<const std::pair<std::int32_t, std::int32_t>> pairs);
  /// Sets the matrix to zero.
  void reset();
  /// Block on the diagonal of the body at `place`, row by row.
  float* diagonal(std::int32_t place) { return &diagonal_[block * place]; }
  /// Block of pair number `pair`, row by row: rows of the later body, columns of the earlier one.
  float* below(std::int32_t pair) { return &below_[block * pair]; }
  void factor();

  /// Solve in place, for rows of eight floats a body: three numbers and a zero in each half. solve_first() leaves the
  /// second half alone, solve_both() solves for both halves.
  void solve_first(float* x);
  void solve_both(float* x);

  std::size_t nodes() const { return front_.size(); }
  /// Numbers that a solution reads.
  std::size_t stored_numbers() const { return forth_.size() + back_.size(); }

 private:
  struct Front {
    std::int32_t place = 0, own = 0, others = 0;  // first body, bodies
    std::int32_t own_rows = 0, other_rows = 0;    // three numbers for each body, filled up to whole packs
    std::int32_t first_other = 0;                 // in other_place_
    std::size_t forth = 0, back = 0;              // H and G
  };

  void find_others(std::span<const std::pair<std::int32_t, std::int32_t>> pairs, std::int32_t node);
  std::int32_t row_in(const Front& f, std::int32_t place) const;
  void assemble(std::int32_t node);
  void add_child(const Front& child, const float* from, const Front& f);
  void invert_own(const Front& f);
  void set_products(const Front& f);
  template <int vectors>
  void forth(const Front& f, float* x);
  template <int vectors>
  void back(const Front& f, float* x);
  template <int vectors>
  void solve_all(float* x);

  std::vector<Front> front_;
  std::vector<std::int32_t> other_place_;    // of the others of each front, ascending
  std::vector<std::int32_t> row_in_parent_;  // of each of them
  std::vector<std::int32_t> first_pair_, later_;
  std::vector<float> diagonal_, below_;
  std::vector<float> forth_, back_;
  std::vector<float> dense_[2], product_[2];  // memory of a solution, for each vector
  // memory of analyse()
  std::vector<std::int32_t> mark_, first_child_, next_child_;
  // memory of factor(): the columns of the own bodies with all rows, those of the others with their own rows, and the
  // complements that wait for their parents, last one on top
  std::vector<float> own_columns_, other_columns_, waiting_;
  std::vector<std::size_t> waiting_from_;
};

}  // namespace gem
