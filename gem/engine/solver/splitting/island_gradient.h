// Gradient iterations of the points of one island, in single precision from one base: cheap, and enough for most
// islands of a drift. They need no matrix. Where they do not reach the tolerance soon, operator splitting takes over.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gem/engine/solver/splitting/body_rows.h"
#include "gem/engine/solver/splitting/gradient_control.h"
#include "gem/engine/solver/splitting/gradient_point.h"
#include "gem/engine/solver/splitting/island.h"

namespace gem {

class IslandGradient {
 public:
  /// Iterates until the tolerance is met, or until that takes too long. `motion`: of each body after the impulses on
  /// entry. Returns whether the tolerance was met; then sets the error, and the iterations unless splitting had more.
  /// `keeps`: whether the impulses that were reached stay if it was not, unless they ran away; then raises the error to
  /// what they ask for.
  bool solve(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
             std::span<const Motion<double>> motion, const IslandControl& control, bool keeps, IslandResult& result);

 private:
  struct alignas(64) Block : GradientPoint<FloatPack> {
    std::int32_t a[float_lanes], b[float_lanes];  // rows of the bodies
  };
  struct Pace {
    float momentum_coefficient, per_step, units;
  };

  void set(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
           std::span<const Motion<double>> motion);
  void move();
  GradientAsked visit(PointFriction law, bool judged, const Pace& pace);
  template <PointFriction law>
  GradientAsked visit_law(bool judged, const Pace& pace);
  template <PointFriction law, bool judged, bool repairs>
  GradientAsked visit_blocks(const Pace& pace);
  // Each is built for AVX2 too.
  GradientAsked visit_frictionless(bool judged, const Pace& pace);
  GradientAsked visit_coulomb(bool judged, const Pace& pace);
  GradientAsked visit_fixed_direction(bool judged, const Pace& pace);

  std::vector<Block> block_;
  std::vector<BodyRow> now_, sum_, inverse_;  // by body + 1; row 0 is fixed
  bool repairs_ = false;                      // whether any point repairs an overlap
};

}  // namespace gem
