// Converged impulses of the contact points of one island: operator splitting with a sparse factor.
//
// An island is a set of moving bodies joined by contacts; fixed bodies do not join. For every point the iteration keeps
// its impulse P and a copy z of its velocity. The copy obeys the contact law together with P, while the velocities w of
// the bodies obey the balance of momentum:
//
//     (M + J^T R J) w = J^T (P + R (z - e0))          e0: velocity of the point before, minus its target
//     a = P - R x,  x = 1.6 (e0 + J w) - 0.6 z        over-relaxed
//     P = a within the bounds of the law,  z = (P - a) / R
//
// (alternating directions, as in OSQP, Stellato et al. 2020; for frictional contact Tasora et al. 2021). R is diagonal:
// `stiffness` over the compliance of the point, and follows the errors. The matrix is the same for all iterations of
// one stiffness, so it is factored once. The position repair has the same matrix and is solved beside the velocities.
//
// The iteration works on additions to a base, as coupled_visit.h does. There is one round: at its end the additions go
// to the base in double precision.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bench/splitting/body_factor.h"
#include "bench/splitting/elimination_order.h"
#include "gem/base/pack.h"
#include "gem/base/vec2.h"
#include "gem/engine/solver/coupled_point.h"
#include "gem/events/friction_memory.h"

namespace gem::bench {

/// A moving body before the impulses of the time step.
struct IslandBody {
  Vec2 position;                 // [m]
  Vec2 velocity;                 // [m/s]
  double spin = 0.0;             // [rad/s]
  double inverse_mass = 0.0;     // [1/kg]
  double inverse_inertia = 0.0;  // [1/(kg m2)]
};

/// A contact point: its bodies, its constants, and its impulse: the last one on entry, the result on return.
struct IslandPoint {
  std::int32_t a = 0, b = 0;  // IslandSolver::fixed: a fixed body
  const PointGeometry<double>* geometry = nullptr;
  PointImpulse<double>* impulse = nullptr;
  SpareFriction spare;  // [N s]
};

struct IslandControl {
  PointFriction friction = PointFriction::coulomb;
  double tolerance = 1e-3;  // of the velocities [m/s]
  double dt = 0.0;          // [s]
  int iterations_maximum = 200;
};

struct IslandResult {
  int iterations = 0;
  double error = 0.0;  // estimate of the largest error of a velocity [m/s]
};

class IslandSolver {
 public:
  static constexpr std::int32_t fixed = -1;

  /// Solves one island: `points` refer to `bodies` by index. The result depends on nothing else.
  IslandResult solve(std::span<const IslandBody> bodies, std::span<const IslandPoint> points,
                     const IslandControl& control);

 private:
  /// Velocity and repair of a body, scaled by the roots of its masses: x, y, spin, 0 and the same of the repair.
  struct alignas(32) Row {
    FloatPack lanes;
  };
  /// Eight points. Unused lanes have both bodies fixed and no bounds to reach.
  struct alignas(64) Block {
    FloatPack n_a[3], n_b[3], t_a[3], t_b[3];  // Jacobian times the roots of the inverse masses
    FloatPack inverse_nn, inverse_tt, friction;
    FloatPack stiff_n, stiff_t, soft_n, soft_t;  // R and 1 / R
    FloatPack excess, slip, least, most, slack_left, slack_right, repair_excess, repair_least;
    FloatPack normal, tangential, repair;         // additions to the base
    FloatPack gap, slide, shift, shift_t;         // copies of the velocities and of the shift
    std::int32_t a[float_lanes], b[float_lanes];  // places of the bodies, 0: fixed
  };

  void order_bodies(std::span<const IslandBody> bodies, std::span<const IslandPoint> points);
  void set_up(std::span<const IslandBody> bodies, std::span<const IslandPoint> points);
  void set_point(std::span<const IslandBody> bodies, const IslandPoint& p, Block& q, int lane);
  void move_by_base(std::span<const IslandBody> bodies, std::span<const IslandPoint> points);
  void set_base(std::span<const IslandPoint> points);
  void add_to_base(std::span<const IslandPoint> points, PointFriction law) const;
  void stiffen(float stiffness);
  void push_all();
  void visit(PointFriction law);
  double error(float per_step);
  float balance() const;
  template <PointFriction law, bool repairs>
  void visit_blocks();
  template <bool repairs>
  void push_blocks();
  template <bool repairs>
  double error_of_blocks(float per_step);
  // Each is built for AVX2 too.
  void visit_frictionless();
  void visit_coulomb();
  void visit_fixed_direction();
  void push_velocities();
  void push_velocities_and_repairs();
  double error_of_velocities();
  double error_of_velocities_and_repairs(float per_step);

  EliminationOrder order_;
  BodyFactor factor_;
  ContactGraph graph_;
  std::vector<Vec2> position_;
  std::vector<std::int32_t> order_list_, fill_;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
  std::vector<std::int32_t> place_;  // of each body in the order of elimination
  std::vector<float> root_mass_;     // root of the inverse mass, by place [kg^-1/2]
  std::vector<Block> block_;
  std::vector<Row> unknown_, sum_, wrong_;  // by place + 1; entry 0 is fixed
  std::vector<Motion<double>> motion_;      // after the impulses of the base, by place
  std::vector<Push<double>> base_push_;
  float point_error_ = 0.0F, body_error_ = 0.0F;  // parts of the last error() [m/s]
  bool repairs_ = false;                          // whether any point repairs an overlap
};

}  // namespace gem::bench
