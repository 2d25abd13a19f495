// Converged impulses of the contact points of one island: operator splitting with a factored matrix.
//
// An island is a set of moving bodies joined by contacts; fixed bodies do not join. The iteration alternates between
// the bodies, whose velocities w obey the balance of momentum, and the points, whose impulses P and velocities z obey
// the contact law (point_blocks.h):
//
//     (M + J^T R J) dw = J^T (P + R (z - u)) - M w,   w += dw,   u = e0 + J w
//
// The velocities u ask for the impulses of the result: P - R u within the bounds.
//
//   e0  velocity of the points with the impulses of the base, minus their target
//   w   change of the velocities of the bodies since the base
//
// (alternating directions, as in OSQP, Stellato et al. 2020; for frictional contact Tasora et al. 2021). The matrix is
// the same for all iterations of one stiffness, so it is factored once. The position repair has the same matrix and is
// solved beside the velocities. Rounding of the factor does not change where the iteration ends, only how fast it gets
// there.
//
// At the end of a round the additions go to the base in double precision, and the next round starts from there.
//
// In most islands gradient iterations come first (island_gradient.h), and often nothing is left for splitting.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/engine/solver/splitting/factor/dissection.h"
#include "gem/engine/solver/splitting/factor/front_factor.h"
#include "gem/engine/solver/splitting/island.h"
#include "gem/engine/solver/splitting/island_crew.h"
#include "gem/engine/solver/splitting/island_gradient.h"
#include "gem/engine/solver/splitting/island_size.h"
#include "gem/engine/solver/splitting/point_blocks.h"
#include "gem/engine/solver/splitting/round_control.h"

namespace gem {

class IslandSolver {
 public:
  static constexpr std::int32_t fixed = IslandPoint::fixed;

  /// Solves one island: `points` refer to `bodies` by index. The result depends on nothing else.
  /// `crew`: threads that help; they change no bit.
  IslandResult solve(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                     const IslandControl& of_case, IslandCrew& crew);

 private:
  void find_pairs(std::span<const IslandPoint> points, std::int32_t bodies);
  void order_bodies(std::span<const IslandBody> bodies, std::span<const IslandPoint> points);
  void set_points(std::span<const IslandBody> bodies, std::span<const IslandPoint> points);
  void move_by_base(std::span<const IslandBody> bodies, std::span<const IslandPoint> points);
  double error_of_base(const IslandControl& control, std::span<const IslandBody> bodies,
                       std::span<const IslandPoint> points) const;
  void set_base(PointFriction law, std::span<const IslandPoint> points);
  void keep_best_share(PointFriction law, std::span<const IslandBody> bodies,
                       std::span<const IslandPoint> points) const;
  GradientPlan plan_of(std::span<const IslandBody> bodies, std::int64_t iterations_maximum) const;
  bool ends_by_gradient(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                        const IslandControl& control, bool keeps, IslandResult& result);
  void stiffen(const RoundControl& round);
  bool change_stiffness(RoundControl& round);
  void iterate_round(RoundKind kind, const IslandControl& control, IslandResult& result);
  void begin();
  void step();
  SplittingDifferences compare(const IslandControl& control);

  IslandSize size_;  // of this island, as the crew
  IslandCrew* crew_ = nullptr;
  IslandGradient gradient_;
  Dissection dissection_;
  EliminationTree tree_;
  FrontFactor factor_;
  ContactGraph graph_;
  PointBlocks blocks_;
  std::vector<Vec2> position_;
  std::vector<std::int32_t> fill_;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
  std::vector<std::int32_t> place_;    // of each body in the order of elimination
  std::vector<BodyRow> scale_, mass_;  // by place: scaled motions to speeds (a spin at the radius of gyration); masses
  std::vector<BodyRow> now_, sum_, given_, last_given_;  // by place + 1; row 0 is fixed
  std::vector<Motion<double>> motion_;                   // of each body after the impulses of the base
  std::vector<Push<double>> push_;
};

}  // namespace gem
