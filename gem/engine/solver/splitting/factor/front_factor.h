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

#include "gem/engine/solver/splitting/factor/dissection.h"
#include "gem/engine/solver/splitting/factor/tree_parts.h"
#include "gem/engine/solver/splitting/island_crew.h"

namespace gem {

class FrontFactor {
 public:
  static constexpr std::int32_t block = 9;        // numbers of a block of 3 x 3: the motions of two bodies
  static constexpr std::int32_t row_numbers = 8;  // of a body in the unknowns of the solve

  /// Finds the fronts. `pairs`: bodies in contact, as places in the order of elimination, the earlier one first;
  /// ascending, each once. `parts`: of the work, for a crew of so many threads; they change no bit.
  void analyse(const EliminationTree& tree, std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
               std::int32_t parts = 1);
  /// Sets the matrix to zero.
  void reset();
  /// Block on the diagonal of the body at `place`, row by row.
  float* diagonal(std::int32_t place) { return &diagonal_[block * place]; }
  /// Block of pair number `pair`, row by row: rows of the later body, columns of the earlier one.
  float* below(std::int32_t pair) { return &below_[block * pair]; }
  void factor(IslandCrew& crew);

  /// Solve in place, for rows of eight floats a body: three numbers and a zero in each half. solve_first() leaves the
  /// second half alone, solve_both() solves for both halves.
  void solve_first(float* x, IslandCrew& crew);
  void solve_both(float* x, IslandCrew& crew);

  std::size_t nodes() const { return front_.size(); }
  const TreeParts& parts() const { return parts_; }
  /// Numbers that a solution reads.
  std::size_t stored_numbers() const { return forth_.size() + back_.size(); }

 private:
  struct Front {
    std::int32_t place = 0, own = 0, others = 0;  // first body, bodies
    std::int32_t own_rows = 0, other_rows = 0;    // three numbers for each body, filled up to whole packs
    std::int32_t first_other = 0;                 // in other_place_
    // others whose sums this front adds to itself; the rest of them are of the trunk, which other parts add to as well
    std::int32_t adds = 0, first_kept = 0;  // and where the sums for the rest are kept: in kept_
    std::size_t forth = 0, back = 0;        // H and G
  };

  /// Memory of a thread.
  struct Memory {
    std::vector<float> dense[2], product[2];  // of a solution, for each vector
    // of factor(): the columns of the own bodies with all rows, those of the others with their own rows, and the
    // complements that wait for their parents, last one on top
    std::vector<float> own_columns, other_columns, waiting;
  };

  void find_others(std::span<const std::pair<std::int32_t, std::int32_t>> pairs, std::int32_t node);
  std::int32_t row_in(const Front& f, std::int32_t place) const;
  void list_children(const EliminationTree& tree);
  void divide(const EliminationTree& tree, std::int32_t parts);
  void make_space(std::size_t bodies, std::size_t pairs, std::int32_t parts);

  void assemble(std::int32_t node, Memory& m);
  void add_child(const Front& child, const float* from, const Front& f, Memory& m);
  void invert_own(const Front& f, Memory& m);
  template <class Pack, int columns>
  void set_forth(const Front& f, std::int32_t r, std::int32_t column, Memory& m);
  template <class Pack, int columns>
  void set_complement(const Front& f, std::int32_t r, std::int32_t column, Memory& m);
  void set_back(const Front& f, Memory& m);
  template <class Wide>
  void set_products(const Front& f, Memory& m);
  template <class Wide>
  void factor_nodes(std::int32_t part);

  enum class Way { forth, back };
  template <class Wide, int vectors>
  void forth(const Front& f, float* x, Memory& m);
  template <class Wide, int vectors>
  void back(const Front& f, float* x, Memory& m);
  template <int vectors>
  void add_kept(const Front& f, float* x) const;
  template <class Wide, int vectors>
  void solve_part(Way way, std::int32_t part, float* x);
  template <class Pass>
  void solve(IslandCrew& crew, Pass&& pass);
  void factor_part(std::int32_t part);
  // Narrow ones are built for AVX2 too, wide ones for AVX-512. `part` trunk(): the trunk.
  void factor_narrow(std::int32_t part);
  void factor_wide(std::int32_t part);
  void solve_first_narrow(Way way, std::int32_t part, float* x);
  void solve_first_wide(Way way, std::int32_t part, float* x);
  void solve_both_narrow(Way way, std::int32_t part, float* x);
  void solve_both_wide(Way way, std::int32_t part, float* x);
  std::int32_t trunk() const { return static_cast<std::int32_t>(parts_.part.size()); }
  const std::vector<std::int32_t>& nodes_of(std::int32_t part) const {
    return part < trunk() ? parts_.part[part] : parts_.trunk;
  }

  std::vector<Front> front_;
  TreeParts parts_;
  std::vector<double> work_;                 // of each node
  std::vector<std::int32_t> other_place_;    // of the others of each front, ascending
  std::vector<std::int32_t> row_in_parent_;  // of each of them
  std::vector<std::int32_t> first_pair_, later_;
  std::vector<float> diagonal_, below_;
  std::vector<float> forth_, back_;
  std::vector<float> kept_;                // sums of the parts for the trunk, as rows
  std::vector<std::int32_t> keeping_;      // nodes with such sums, ascending
  std::vector<Memory> memory_;             // of each part, and of the trunk
  std::vector<std::size_t> waiting_from_;  // of each node, in the memory of its part
  // memory of analyse()
  std::vector<std::int32_t> mark_, node_of_place_, first_child_, next_child_;
};

}  // namespace gem
