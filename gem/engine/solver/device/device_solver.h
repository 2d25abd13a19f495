// The iterations of a coupled time step on a device, by one thread group. The algorithm is that of coupled_solver.cpp.
//
// | step, a barrier after each | by points                                    | by bodies                     |
// |----------------------------|----------------------------------------------|-------------------------------|
// | list                       |                                              | entries, rows, records        |
// | begin                      | geometry, last impulses, pushes of the base  |                               |
// | settle                     |                                              | velocities under the base     |
// | start of a round           | frame at the base, pushes                    |                               |
// | move                       |                                              | motions under the additions   |
// | visit                      | next additions, pushes, residual             |                               |
// | end of a round             | additions enter the base, pushes of the base |                               |
//
// device_solver_list.h makes the list, device_base.h keeps the base, device_rounds.h runs the rounds. Blocks with
// halos (device_halo.h) have no barrier after a move. After a visit they have one only where the residual is judged.
#pragma once

#include "gem/engine/solver/device/device_halo.h"
#include "gem/engine/solver/device/device_rounds.h"
#include "gem/engine/solver/splitting/device/device_islands.h"
#include "gem/engine/step/contact_quality.h"

namespace gem {

template <class Group>
class StepSolver {
 public:
  /// `shared_bytes`: size of the part of each block's shared memory that the solver may use; it begins at the start.
  GEM_DEVICE StepSolver(const DeviceScene& s, Group& group, std::int32_t step, std::size_t shared_bytes)
      : s_(s), group_(group), shared_bytes_(shared_bytes), step_(step) {}

  /// Solves the time step in one launch, by blocks with halos.
  GEM_DEVICE void solve() {
    SolverList<Group>(s_, group_, step_, shared_bytes_).make();
    begin_points();
    SolverHalo<Group>(s_, group_, shared_bytes_).activate();
    end(SolverRounds<Group>::iterate(s_, group_));
  }

  /// Everything before the iterations. They follow in a launch with the same number of blocks, each with `shared_bytes`
  /// of shared memory.
  GEM_DEVICE void begin_ahead() {
    SolverList<Group>(s_, group_, step_, shared_bytes_).make_ahead();
    if (s_.constants.iteration == Iteration::splitting)
      begin_islands();
    else
      begin_points();
  }

  /// Everything after the iterations. `residual_met`: they met their residual.
  GEM_DEVICE void end(bool residual_met) {
    SolverBase<Group>(s_, group_).keep_best_share(share_limit(s_.constants.point_friction, residual_met));
    hand_back_points();
  }

  /// Everything after the islands are solved.
  GEM_DEVICE void end_islands() {
    SolverList<Group>(s_, group_, step_, shared_bytes_).load();
    SolverBase<Group>(s_, group_).apply_base();
    group_.barrier();
    if (rank_of(group_) == 0) {
      group_.shared().iterations = static_cast<std::int32_t>(s_.island.counters->iterations);
      group_.shared().residual = strict::double_of(s_.island.counters->error_bits);
    }
    hand_back_points();
  }

 private:
  /// Sets the base to the impulses of the same points one time step ago, and finds the islands.
  GEM_DEVICE void begin_islands() {
    IslandFinder<Group> islands(s_, group_);
    group_.barrier();
    each_point(group_, [&](std::int32_t i) { begin_point(i); });
    islands.begin();
    clear_marks();
    group_.barrier();
    islands.find();
  }

  GEM_DEVICE void hand_back_points() {
    each_point(group_, [&](std::int32_t i) { hand_back(i); });
    if (s_.wants_samples) SolverBase<Group>(s_, group_).add_work_created();
  }

  /// Sets the base to the impulses of the same points one time step ago.
  GEM_DEVICE void begin_points() {
    SolverBase<Group> base(s_, group_);
    group_.barrier();
    each_point(group_, [&](std::int32_t i) { begin_point(i); });
    clear_marks();
    if constexpr (Group::has_halos) SolverHalo<Group>(s_, group_, shared_bytes_).make();
    group_.barrier();
    base.apply_base();
    group_.barrier();
    base.keep_best_share(1.0);
  }

  GEM_DEVICE void clear_marks() {
    for (std::int32_t w = rank_of(group_); w < bit_words(s_); w += size_of(group_))
      s_.touched_bodies[w] = s_.touched_sorted[w] = 0;
    for (std::int32_t i = rank_of(group_); i < s_.bodies; i += size_of(group_)) s_.work_created[i] = 0.0;
    if (rank_of(group_) == 0)
      s_.counters->residual_bits[0] = s_.counters->residual_bits[1] = s_.counters->residual_bits[2] = 0;
  }

  GEM_DEVICE std::int32_t points_of(std::int32_t body) const {
    const BodyPoints points = s_.body_points[body];
    return points.step == step_ ? points.count : 0;
  }

  GEM_DEVICE double cap_of(const Contact& contact, const BodyCell& a, const BodyCell& b) const {
    const bool ice = a.kind == BodyKind::floe || b.kind == BodyKind::floe;
    const CrushingPowers of_a = s_.crushing[contact.a], of_b = s_.crushing[contact.b];
    return largest_impulse(s_.constants.events, ice, crushed_thickness(a.kind, of_a.thickness, of_b.thickness),
                           smaller(of_a.width, of_b.width), contact.count);
  }

  GEM_DEVICE void begin_point(std::int32_t i) {
    const PointCell point = s_.point[s_.taken[i]];
    Contact& contact = s_.contact[point.pair];
    ContactSlot& slot = contact.slot[point.slot];
    const BodyCell &a = s_.body[point.a.body], &b = s_.body[point.b.body];
    const PointMemory last = memory_of(s_.memory[point.pair], slot.feature, step_);
    const CollisionMass mass_a{a.inverse_mass, a.inverse_inertia}, mass_b{b.inverse_mass, b.inverse_inertia};
    recall(s_.constants, contact, slot, mass_a, mass_b, last);
    const double cap = cap_of(contact, a, b);
    const PointGeometry<double> geometry =
        point_geometry(s_.constants, contact, slot, shared_mass(mass_a, points_of(point.a.body)),
                       shared_mass(mass_b, points_of(point.b.body)), last, cap);
    PointImpulse<double> start = last.impulse;
    start.repair = repair_to_go_on(s_.constants, start.repair, geometry.nn);
    slot.cap = cap;
    s_.points.set(i, geometry);
    s_.points.set(i, slot.spare);
    s_.taken_point[i] = point;
    write_base(s_, i, point, geometry, start);
  }

  /// Writes the impulse of a point to its contact.
  GEM_DEVICE void hand_back(std::int32_t i) {
    const PointCell point = s_.taken_point[i];
    Contact& contact = s_.contact[point.pair];
    ContactSlot& slot = contact.slot[point.slot];
    const PointImpulse<double> p = s_.points.impulse(i);
    slot.impulse.normal = p.normal;
    slot.impulse.tangential = p.tangential;
    slot.repair = p.repair;
    remember(s_.memory[point.pair], contact, point.slot, p, step_);
    if (s_.wants_samples) judge_point(point, contact, slot);
  }

  GEM_DEVICE void judge_point(const PointCell& point, const Contact& contact, const ContactSlot& slot) {
    BlockCell& shared = group_.shared();
    const BodyCell &a = s_.body[point.a.body], &b = s_.body[point.b.body];
    const SolvedMotion &of_a = s_.solved[point.a.body], &of_b = s_.solved[point.b.body];
    PairBodies after;
    after.velocity_a = {of_a.part[0], of_a.part[1]};
    after.velocity_b = {of_b.part[0], of_b.part[1]};
    after.spin_a = of_a.part[4];
    after.spin_b = of_b.part[4];
    const PointQuality quality = point_quality(contact, slot, {a.inverse_mass, a.inverse_inertia},
                                               {b.inverse_mass, b.inverse_inertia}, relative_velocity(after, slot));
    if (slot.separation <= 0.0 || slot.impulse.normal > 0.0) group_.add(&shared.contacts, 1);
    if (quality.complementarity > 0.0)
      group_.highest(&shared.complementarity, strict::bits_of(quality.complementarity));
    if (quality.cone_excess > 0.0) group_.highest(&shared.cone_excess, strict::bits_of(quality.cone_excess));
    const bool with_b = b.inverse_mass > 0.0;
    if (point.b.place >= 0) s_.push_base[point.b.place].part[solved_work] = with_b ? quality.work : 0.0;
    if (point.a.place >= 0) s_.push_base[point.a.place].part[solved_work] = with_b ? 0.0 : quality.work;
  }

  const DeviceScene& s_;
  Group& group_;
  std::size_t shared_bytes_;
  std::int32_t step_;
};

/// Solves a coupled time step, between the pair stages and the body stages.
template <class Group>
GEM_DEVICE inline void resolve_coupled(const DeviceScene& s, Group& group, const Workspace& workspace,
                                       std::int32_t step) {
  if (s.counters->points == 0) return;
  StepSolver<Group>(s, group, step, workspace.solver_bytes).solve();
  group.barrier();
}

}  // namespace gem
