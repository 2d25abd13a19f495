// The base of the iterations of a coupled time step, in double precision: impulses, the motions that they give, and the
// fraction of the impulses that leaves the least energy.
#pragma once

#include "gem/engine/solver/device/device_solver_list.h"
#include "gem/engine/step/ordered_sum.h"

namespace gem {

/// Index in PushBase::part of the work of the point, stored at the end of a time step with the body that books it [J].
constexpr int solved_work = 7;

/// Sets the base impulse of a point, and writes what it gives to both bodies.
GEM_DEVICE inline void write_base(const DeviceScene& s, std::int32_t i, const PointCell& point,
                                  const PointGeometry<double>& g, const PointImpulse<double>& p) {
  s.points.set(i, p);
  const auto write = [&](std::int32_t place, double lever_n, double lever_t) {
    if (place < 0) return;
    const Push<double> push = push_of(g, p, lever_n, lever_t);
    s.push_base[place] = {{push.x, push.y, push.shift_x, push.shift_y, push.twist, push.turn, 0.0, 0.0}};
  };
  write(point.a.place, g.lever_a_n, g.lever_a_t);
  write(point.b.place, g.lever_b_n, g.lever_b_t);
}

template <class Group>
class SolverBase {
 public:
  GEM_DEVICE SolverBase(const DeviceScene& s, Group& group) : s_(s), group_(group) {}

  /// Computes the velocities and shifts of the block's bodies under the base impulses, and the work on each body.
  GEM_DEVICE void apply_base() {
    const auto lanes = group_.lanes();
    constexpr int size = Group::Lanes::size, each = 8 / size, together = 4;
    for (std::int32_t e = workspace().own.begin + group_.thread() / size; e < workspace().own.end;
         e += group_.threads() / size) {
      const SolverEntry& entry = workspace().entry[e];
      const std::int32_t body = entry.body, as_b = entry.as_b, count = entry.count;
      const PushBase* const record = s_.push_base + entry.place;
      // loaded before the sum to hide the latency of memory
      const BodyCell& cell = s_.body[body];
      const double inverse_mass = cell.inverse_mass, inverse_inertia = cell.inverse_inertia, spin_before = cell.spin;
      const Vec2 before = cell.velocity;
      const double mass = s_.motion[body].mass, inertia = s_.motion[body].inertia;
      double sum[each] = {};
      GEM_NO_UNROLL
      for (std::int32_t first = 0; first < count; first += together)
        for (int j = 0; j < each; ++j) {
          const int c = lanes.rank() + j * size;
          double some[together];
          for (int k = 0; k < together; ++k)
            if (first + k < count) some[k] = record[first + k].part[c];
          for (int k = 0; k < together; ++k) {
            if (first + k >= count) break;
            sum[j] += first + k < as_b ? some[k] : -some[k];
          }
        }
      for (int j = 0; j < each; ++j) {
        const int c = lanes.rank() + j * size;
        const double moved = (c < 4 ? inverse_mass : inverse_inertia) * sum[j];
        sum[j] = c == 0 ? before.x + moved : c == 1 ? before.y + moved : c == 4 ? spin_before + moved : moved;
        s_.solved[body].part[c] = sum[j];
      }
      const double x = lanes.from(sum[0], 0), y = lanes.from(sum[1 / size], 1 % size),
                   spin = lanes.from(sum[4 / size], 4 % size);
      if (lanes.rank() != 0) continue;
      const EnergyChange change =
          energy_change({x, y, spin, 0.0, 0.0, 0.0}, before.x, before.y, spin_before, mass, inertia);
      s_.linear_energy[entry.rank] = change.linear;
      s_.quadratic_energy[entry.rank] = change.quadratic;
    }
  }

  /// As CoupledSolver::keep_best_share(): scales the base impulses if the best fraction is below `limit`.
  GEM_DEVICE void keep_best_share(double limit) {
    const Sums work = ordered_sums<2>(s_.linear_energy, s_.quadratic_energy, workspace().bodies);
    const double share = best_share({work.first, work.second});
    if (!(share < limit)) return;
    each_point(group_, [&](std::int32_t i) {
      PointImpulse<double> impulse = s_.points.impulse(i);
      impulse.normal *= share;
      impulse.tangential *= share;
      write_base(s_, i, s_.taken_point[i], s_.points.geometry(i), impulse);
    });
    group_.barrier();
    apply_base();
    group_.barrier();
  }

  /// Sums the work of the contacts for each body, then over all. Positive: the events created energy [J].
  GEM_DEVICE void add_work_created() {
    group_.barrier();
    for (std::int32_t e = workspace().own.begin + group_.thread(); e < workspace().own.end; e += group_.threads()) {
      const SolverEntry& entry = workspace().entry[e];
      constexpr int some_records = 4;
      double sum = 0.0;
      GEM_NO_UNROLL
      for (std::int32_t first = 0; first < entry.count; first += some_records) {
        double some[some_records];
        for (int k = 0; k < some_records; ++k)
          some[k] = first + k < entry.count ? s_.push_base[entry.place + first + k].part[solved_work] : 0.0;
        for (const double term : some) sum += term;  // zeros beyond the last change no sum that began with +0
      }
      s_.work_created[entry.body] = sum;
    }
    group_.barrier();
    if (group_.block() != 0) return;
    const double sum = ordered_sums<1>(s_.work_created, s_.work_created, s_.bodies).first;
    if (group_.thread() == 0) group_.shared().energy_created = larger(sum, 0.0);
  }

 private:
  GEM_DEVICE const SolverWorkspace& workspace() const { return group_.shared().workspace; }

  /// Groups of terms that a group of lanes adds in one pass, loaded together to hide the latency of memory.
  static constexpr int groups_together = Group::kept_points > 1 ? 4 : 1;  // as many as there are registers for
  static constexpr int lane_count = Group::Lanes::size, fours = sum_width / 4 / lane_count;

  /// Groups of four neighbouring terms that one lane adds first.
  struct LaneTerms {
    double four[fours][4];
  };
  GEM_DEVICE LaneTerms lane_terms(const double* from, std::int32_t count) const {
    LaneTerms terms;
    for (int j = 0; j < fours; ++j)
      for (int c = 0; c < 4; ++c) {
        const int at = 4 * (group_.lanes().rank() + j * lane_count) + c;
        terms.four[j][c] = at < count ? from[at] : 0.0;
      }
    return terms;
  }
  /// As sum_of_eight(): adds sums of four at distances 4, 2 and 1.
  GEM_DEVICE double sum_by_lanes(const LaneTerms& terms) const {
    double sum[fours];
    for (int j = 0; j < fours; ++j) sum[j] = sum_of_four(terms.four[j]);
    for (int distance = 4; distance > 0; distance /= 2)
      if (distance < lane_count)
        sum[0] += group_.lanes().partner(sum[0], distance);
      else
        for (int j = 0; j < distance / lane_count; ++j) sum[j] += sum[j + distance / lane_count];
    return sum[0];
  }

  /// ordered_sum() of `kinds` lists (1 or 2) of `count` terms each. Every block computes it for itself.
  struct Sums {
    double first, second;
  };
  template <int kinds>
  GEM_DEVICE Sums ordered_sums(const double* terms, const double* others, std::int32_t count) {
    static_assert(kinds == 1 || kinds == 2);
    if (count == 0) return {0.0, 0.0};
    const std::int32_t most = (s_.bodies + sum_width - 1) / sum_width;
    double* to = s_.partial_sum + static_cast<std::int64_t>(group_.block()) * 4 * (most + 1);
    const std::int32_t lane_group = group_.thread() / lane_count, step = group_.threads() / lane_count;
    do {
      const std::int32_t made = (count + sum_width - 1) / sum_width;
      for (std::int32_t k = lane_group; k < kinds * made; k += groups_together * step) {
        LaneTerms some[groups_together] = {};
        for (int j = 0; j < groups_together; ++j) {
          const std::int32_t at = k + j * step;
          if (at >= kinds * made) break;
          const bool other = kinds == 2 && at >= made;
          const std::int32_t begin = sum_width * (other ? at - made : at);
          some[j] = lane_terms((other ? others : terms) + begin, count - begin);
        }
        for (int j = 0; j < groups_together; ++j) {
          const double sum = sum_by_lanes(some[j]);
          if (k + j * step < kinds * made && group_.lanes().rank() == 0) to[k + j * step] = sum;
        }
      }
      group_.block_barrier();
      terms = to;
      others = kinds == 2 ? to + made : to;
      to += kinds * made;
      count = made;
    } while (count > 1);
    const Sums sums{*terms, *others};
    group_.block_barrier();  // before the memory is used again
    return sums;
  }

  const DeviceScene& s_;
  Group& group_;
};

}  // namespace gem
