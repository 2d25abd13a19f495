// The iterations of a coupled time step by operator splitting: finds the islands and solves each by itself.
//
// The result of an island depends on its own bodies and points only. Nothing that happens elsewhere changes a bit of
// it.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/splitting/island_solver.h"

namespace gem::bench {

class SplitIteration {
 public:
  static constexpr std::int32_t fixed = IslandSolver::fixed;

  void begin(std::int32_t bodies, std::int32_t points);
  void set_body(std::int32_t i, const IslandBody& body) { body_[i] = body; }
  /// The points of a body must come in an order that does not depend on the number of threads.
  void set_point(std::int32_t i, const IslandPoint& point) { point_[i] = point; }
  /// Writes the impulses of all points. Returns the most iterations and the largest error of all islands.
  IslandResult iterate(const IslandControl& control);

 private:
  std::int32_t root_of(std::int32_t body);
  void find_islands();

  std::vector<IslandBody> body_;
  std::vector<IslandPoint> point_;
  std::vector<std::int32_t> parent_;  // of each body: another one of the same island, or itself
  std::vector<std::int32_t> island_;  // of each body
  // bodies and points sorted by island, and where each island begins
  std::vector<IslandBody> island_body_;
  std::vector<IslandPoint> island_point_;
  std::vector<std::int32_t> first_body_, first_point_, index_;
  IslandSolver solver_;
};

}  // namespace gem::bench
