// The islands of a time step, each solved by itself by operator splitting.
//
// The result of an island depends on its own bodies and points only. Nothing that happens elsewhere changes a bit of
// it.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "gem/engine/solver/splitting/island_solver.h"

namespace gem {

class Islands {
 public:
  static constexpr std::int32_t fixed = IslandSolver::fixed;

  /// Makes room for a time step. `threads`: number of ranks that call solve().
  void begin(std::int32_t bodies, std::int32_t points, int threads);
  void set_body(std::int32_t i, const IslandBody& body) { body_[i] = body; }
  /// The points of a body must come in an order that does not depend on the number of threads.
  void set_point(std::int32_t i, const IslandPoint& point) { point_[i] = point; }
  /// Finds the islands, after all bodies and points are set.
  void find();
  /// Solves islands until none is left, and writes the impulses of their points. All threads of begin() call it side by
  /// side. Those with nothing left to do help thread 0 with the largest islands.
  void solve(const IslandControl& control, int rank);
  /// The most iterations and the largest error of all islands.
  IslandResult worst() const;

 private:
  void solve_island(std::int32_t island, const IslandControl& control, int rank, IslandCrew& crew);
  std::int32_t root_of(std::int32_t body);
  std::int32_t number_islands();

  std::vector<IslandBody> body_;
  std::vector<IslandPoint> point_;
  std::vector<std::int32_t> parent_;  // of each body: another one of the same island, or itself
  std::vector<std::int32_t> island_;  // of each body
  // bodies and points sorted by island, and where each island begins
  std::vector<IslandBody> island_body_;
  std::vector<IslandPoint> island_point_;
  std::vector<std::int32_t> first_body_, first_point_, index_, by_size_;
  std::vector<IslandSolver> solver_;  // of each thread
  std::int32_t shared_ = 0;           // the first islands of by_size_, which all threads solve together
  IslandCrew crew_, alone_;
  std::vector<IslandResult> result_;   // of each thread: the worst
  std::atomic<std::int32_t> next_{0};  // place in by_size_
};

}  // namespace gem
