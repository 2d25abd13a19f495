// The coupled iterations on the host, eight points at a time in single precision.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/pack.h"
#include "gem/engine/solver/coupled_layout.h"
#include "gem/engine/solver/coupled_visit.h"

namespace gem {

/// Impulses added to a base, with the data of points and bodies that the iterations need. Points are in blocks of
/// eight.
class CoupledRounds {
 public:
  void resize(const CoupledLayout& layout);

  /// Sets the constants of a point for the time step.
  void set_geometry(std::int32_t point, const PointGeometry<double>& g, std::int32_t entry_a, std::int32_t entry_b);
  /// Entries of the two bodies of a point.
  std::int32_t entry_a(std::int32_t point) const {
    return block_[point / float_lanes].a[point % float_lanes] / float_lanes;
  }
  std::int32_t entry_b(std::int32_t point) const {
    return block_[point / float_lanes].b[point % float_lanes] / float_lanes;
  }
  /// Sets the base of the next round. The additions so far are part of it and become zero.
  void set_base(std::int32_t point, const PointGeometry<double>& g, SpareFriction spare,
                const PointImpulse<double>& base, const Motion<double>& a, const Motion<double>& b);
  /// Sets inverse mass and inertia of a moving body and zeroes its added motion.
  void set_body(std::int32_t entry, double inverse_mass, double inverse_inertia);
  /// The base plus the additions of the round.
  PointImpulse<double> with_additions(PointFriction law, std::int32_t point, const PointGeometry<double>& g,
                                      SpareFriction spare, const PointImpulse<double>& base) const;

  /// Visits the points of blocks [begin, end). Returns the largest velocity correction of a point [m/s] if `judged`,
  /// else 0.
  float visit(PointFriction law, bool judged, std::int32_t begin, std::int32_t end, StepLength<float> pace,
              float momentum_coefficient);
  /// Writes the pushes of the extrapolated additions without a visit.
  void push(std::int32_t begin, std::int32_t end);
  /// Updates the motion of entries [begin, end) by the pushes of their points, summed in the order of the points.
  void move(const CoupledLayout& layout, std::int32_t begin, std::int32_t end);

 private:
  struct alignas(32) Row {
    FloatPack lanes;
  };
  struct alignas(64) Block {
    FloatPack normal_x, normal_y, lever_a_n, lever_a_t, lever_b_n, lever_b_t, inverse_nn, inverse_tt, nt, friction;
    FloatPack excess, slip, least, most, slack_left, slack_right, repair_excess, repair_least;
    std::int32_t a[float_lanes], b[float_lanes];  // offsets of the bodies' motions, in floats
  };
  struct alignas(32) BlockAddition {
    PointImpulse<FloatPack> added, extrapolated;
  };

  void move_body(std::int32_t entry, const FloatPack& to_b, const FloatPack& to_a);
  void move_any(const CoupledLayout& layout, std::int32_t begin, std::int32_t end);
  template <int as_b, int as_a>
  void move_alike(const CoupledLayout& layout, std::int32_t begin, std::int32_t end);
  template <int as_b>
  void move_alike(const CoupledLayout& layout, std::int32_t begin, std::int32_t end, std::int32_t as_a);

  static PointFrame<FloatPack> frame_of(const Block& b);
  Approach<FloatPack> approach_of(const Block& b) const;
  void write_push(std::int32_t block);
  template <PointFriction law, bool judged>
  float visit_range(std::int32_t begin, std::int32_t end, StepLength<float> pace, float momentum_coefficient);
  float visit_frictionless(bool judged, std::int32_t begin, std::int32_t end, StepLength<float> pace,
                           float momentum_coefficient);
  float visit_coulomb(bool judged, std::int32_t begin, std::int32_t end, StepLength<float> pace,
                      float momentum_coefficient);
  float visit_fixed_direction(bool judged, std::int32_t begin, std::int32_t end, StepLength<float> pace,
                              float momentum_coefficient);

  std::vector<Block> block_;
  std::vector<BlockAddition> addition_;
  std::vector<Row> push_;    // per point: x, y, shift x, y for both bodies; twist and turn for A, then for B
  std::vector<Row> motion_;  // per entry: x, y, shift x, y, spin, turn, spin, turn
  std::vector<Row> answer_;  // per entry: inverse masses and inertias, in the order of motion_
};

}  // namespace gem
