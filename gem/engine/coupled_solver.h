// The coupled resolution on the host: all events of one moment together, iterated to a stated residual.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/pack.h"
#include "gem/engine/contact.h"
#include "gem/engine/coupled_point.h"
#include "gem/engine/engine.h"
#include "gem/engine/field_state.h"
#include "gem/engine/thread_team.h"

namespace gem {

/// Keeps what lasts from moment to moment: the impulses of the last one.
class CoupledSolver {
 public:
  /// Moments with fewer contacts are iterated by one thread: the wait after each phase would cost more than it brings.
  explicit CoupledSolver(std::size_t contacts_worth_threads = 2048) : contacts_worth_threads_(contacts_worth_threads) {}

  /// Inside a team's run: resolves the contacts (ascending in a, b); changes velocities, impulses and repair shifts.
  void resolve(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, MomentQuality& quality);

  const std::vector<std::uint64_t>& keys() const { return keys_; }
  const std::vector<PointImpulse<double>>& impulses() const { return impulses_; }
  void restore(std::vector<std::uint64_t> keys, std::vector<PointImpulse<double>> impulses);

 private:
  /// What both the visit of a point and its two bodies read; one line of memory.
  struct alignas(64) Face {
    Pack side_a;  // normal x, y, lever of A along the normal and the tangent
    Pack side_b;  // lever of B along the normal and the tangent, target, friction
  };
  /// The rest of four points side by side.
  struct alignas(32) Block {
    Pack cap, repair_target;
    std::int32_t a[pack_lanes], b[pack_lanes];  // into motion_
  };
  struct alignas(32) BlockImpulse : PointImpulse<Pack> {};
  using Impulses = std::vector<BlockImpulse>;  // per block
  struct alignas(64) BodyMotion {
    Pack linear;  // velocity x, y, spin; inverse mass times the number of points
    Pack repair;  // shift x, y, turn; inverse inertia times the number of points
  };
  struct alignas(64) BodyStart {
    Pack velocity;  // x, y, spin before the events; unused
    Pack answer;    // inverse mass twice, inverse inertia; unused
  };

  void lay_out(const FieldState& f, Contacts contacts);
  void order_bodies(const FieldState& f);
  std::size_t last_key_from(std::size_t at, std::uint64_t key) const;
  void warm_start(const Contact& contact, std::int32_t first, std::size_t at);
  void fill_points(const FieldState& f, Contact& contact, std::int32_t first);
  void begin_range(const FieldState& f, Contacts contacts, std::int64_t begin, std::int64_t end);
  void iterate(const FieldState& f, ThreadTeam& team, int rank);
  template <PointFriction law>
  void visit_range(std::int32_t begin, std::int32_t end, double dt, double ahead, int rank);
  void visit_frictionless(std::int32_t begin, std::int32_t end, double dt, double ahead, int rank);
  void visit_coulomb(std::int32_t begin, std::int32_t end, double dt, double ahead, int rank);
  void visit_fixed_direction(std::int32_t begin, std::int32_t end, double dt, double ahead, int rank);
  void move_bodies(const Impulses& impulses, std::int32_t begin, std::int32_t end);
  void weigh_impulses(const FieldState& f, std::int32_t begin, std::int32_t end);
  void scale_impulses(std::int32_t begin, std::int32_t end, double share);
  void hand_back(FieldState& f, Contacts contacts, ThreadTeam& team, int rank);

  std::vector<std::uint64_t> keys_;
  std::vector<PointImpulse<double>> impulses_;
  std::vector<std::uint64_t> next_keys_;  // of this moment, while the last one's are still read
  std::vector<PointImpulse<double>> next_impulses_;

  std::vector<std::int32_t> first_point_;  // per contact
  std::vector<Face> face_;                 // per point
  std::vector<Block> block_;
  Impulses impulse_, carried_;
  std::vector<double> climb_;            // per point, then used up by its sum
  std::vector<std::int32_t> points_of_;  // per body of the field
  std::vector<std::int32_t> index_of_;   // per body of the field: into motion_
  std::vector<BodyMotion> motion_;
  std::vector<BodyStart> start_;      // per entry of motion_ that moves
  std::vector<std::int32_t> moving_;  // bodies that move and have points, ascending
  // per entry of motion_ that moves; its points as B all come before its points as A, which stand in a row
  std::vector<std::int32_t> body_, rank_, first_as_a_, end_as_a_, begin_as_b_;
  std::vector<std::int32_t> points_as_b_;  // per body of the field
  std::vector<std::uint32_t> as_b_;        // points
  std::vector<std::int32_t> next_as_b_;

  struct alignas(64) Most {  // one per thread
    double speed = 0.0;
  };
  std::vector<Most> most_;
  std::int32_t iterations_ = 0;
  double residual_ = 0.0;
  double climb_sum_ = 0.0;
  std::vector<double> given_, answered_;  // per entry of motion_: impulse on its velocity before, and on its change [J]
  double share_ = 1.0;
  ThreadTeam alone_{1};
  std::size_t contacts_worth_threads_;
};

}  // namespace gem
