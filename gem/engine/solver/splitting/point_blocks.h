// The points of an island during the iterations of operator splitting, eight at a time; split_point.h says what a point
// does.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/solver/splitting/body_rows.h"
#include "gem/engine/solver/splitting/factor/front_factor.h"
#include "gem/engine/solver/splitting/island_crew.h"
#include "gem/engine/solver/splitting/split_point.h"

namespace gem {

class PointBlocks {
 public:
  void resize(std::int32_t points);
  /// Sets a point between the bodies in rows `a` and `b`; row 0 is for fixed bodies. `pair`: number of the pair in the
  /// factor, if both move.
  void set_point(std::int32_t k, const PointGeometry<double>& g, std::int32_t a, std::int32_t b, InverseMass of_a,
                 InverseMass of_b, std::int32_t pair);
  /// Begins a round: sets the bounds of the additions, and copies of the velocities that obey the law of friction and
  /// contact with the impulses of the base (not the law of crushing: the first visit takes care of that). `a`, `b`:
  /// motions that the base gives.
  void set_base(PointFriction law, std::int32_t k, const PointGeometry<double>& g, SpareFriction spare,
                const PointImpulse<double>& impulse, const Motion<double>& a, const Motion<double>& b);
  /// Sets R of all points and adds J^T R J to the matrix. `raised`: whether those that raise() found are stiffer.
  void stiffen(float stiffness, bool raised, FrontFactor& factor);

  /// Adds what the points ask of the bodies to `sum`. `now`: motions of the bodies.
  void push(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) const;
  /// Visits all points, and adds what they ask of the bodies to `sum`.
  void visit(PointFriction law, const std::vector<BodyRow>& now, std::vector<BodyRow>& sum, IslandCrew& crew);
  /// Sets the impulses that the velocities ask for, without over-relaxation, and adds their pushes to `given`. Points
  /// that stick get exactly what the bodies have.
  void answer(PointFriction law, const std::vector<BodyRow>& now, std::vector<BodyRow>& given);
  /// Largest difference between the velocities of the points and their copies [m/s]. A shift of the repair counts
  /// `per_step` times [1/s].
  float mismatch(const std::vector<BodyRow>& now, float per_step) const;
  /// Counts for each point how often in a row its velocity and the copy differed in the same direction, by more than
  /// `tolerance` [m/s] and by more than half of the last difference. Repairs are left out.
  void watch(const std::vector<BodyRow>& now, float tolerance);
  /// Makes the points stiffer whose difference persisted twice. A light body between heavy ones needs it: its own
  /// compliance says nothing about the load that passes through it. Returns whether there were any.
  bool raise();
  /// Adds the last answer() of a point to its impulse.
  void add_to(PointFriction law, std::int32_t k, const PointGeometry<double>& g, SpareFriction spare,
              PointImpulse<double>& impulse) const;

  bool repairs() const { return repairs_; }

 private:
  /// Eight points. Unused lanes have both bodies fixed and no bounds to reach.
  struct alignas(64) Block : SplitPoint<FloatPack> {
    std::int32_t a[float_lanes], b[float_lanes], pair[float_lanes];
  };
  template <bool repairs>
  void push_blocks(const std::vector<BodyRow>& now, std::vector<BodyRow>& sum) const;
  /// Some blocks, and where their pushes go: to `sum`, or beside the block in kept_ if they are to be added later.
  struct Visit {
    const std::vector<BodyRow>& now;
    std::vector<BodyRow>& sum;
    std::int32_t first, last;
    bool keeps;
  };
  template <PointFriction law, bool repairs, bool keeps>
  void visit_blocks(const Visit& v);
  template <PointFriction law>
  void visit_law(const Visit& v);
  template <bool repairs>
  void add_kept_blocks(std::int32_t first, std::vector<BodyRow>& sum) const;
  void add_kept(std::int32_t first, std::vector<BodyRow>& sum) const;
  void visit(PointFriction law, const Visit& v);
  template <PointFriction law, bool repairs>
  void answer_blocks(const std::vector<BodyRow>& now, std::vector<BodyRow>& given);
  template <PointFriction law>
  void answer_law(const std::vector<BodyRow>& now, std::vector<BodyRow>& given);
  // Each is built for AVX2 too.
  void visit_frictionless(const Visit& v);
  void visit_coulomb(const Visit& v);
  void visit_fixed_direction(const Visit& v);

  std::vector<Block> block_;
  std::vector<BlockPushes<true>> kept_;
  bool repairs_ = false;  // whether any point repairs an overlap
};

}  // namespace gem
