// The base of the iterations of a coupled moment, in double precision: impulses, the motions that they give, and the
// share of them that leaves the least energy.
#pragma once

#include "gem/engine/device_solver_list.h"
#include "gem/engine/ordered_sum.h"

namespace gem {

constexpr int solved_work = 7;  // part of a PushBase: work of a contact that stands with this body, at the moment's end

/// Enters the base's impulses of a point, and what they give to both bodies.
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

template <class Crew>
class SolverBase {
 public:
  GEM_DEVICE SolverBase(const DeviceScene& s, Crew& crew) : s_(s), crew_(crew) {}

  /// Velocities that the base's impulses give, and what they do to the energy.
  GEM_DEVICE void settle() {
    const auto lanes = crew_.lanes();
    constexpr int size = Crew::Lanes::size, each = 8 / size, together = 4;
    for (std::int32_t e = desk().own.begin + crew_.thread() / size; e < desk().own.end; e += crew_.threads() / size) {
      const SolverEntry& entry = desk().entry[e];
      const std::int32_t body = entry.body, as_b = entry.as_b, count = entry.count;
      const PushBase* const record = s_.push_base + entry.place;
      // asked for before the records are added up: each waits for memory
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
      const ImpulseWork work =
          work_on_body({x, y, spin, 0.0, 0.0, 0.0}, before.x, before.y, spin_before, mass, inertia);
      s_.given[entry.rank] = work.given;
      s_.answered[entry.rank] = work.answered;
    }
  }

  /// As CoupledSolver::keep_best_share().
  GEM_DEVICE void keep_best_share(double limit) {
    const double share = best_share(summed_work(s_.given, s_.answered, desk().bodies));
    if (!(share < limit)) return;
    each_point(crew_, [&](std::int32_t i) {
      PointImpulse<double> impulse = s_.points.impulse(i);
      impulse.normal *= share;
      impulse.tangential *= share;
      write_base(s_, i, s_.taken_point[i], s_.points.geometry(i), impulse);
    });
    crew_.barrier();
    settle();
    crew_.barrier();
  }

  /// Work of the contacts of each body, then of all: positive, where the events gave energy.
  GEM_DEVICE void add_work_created() {
    crew_.barrier();
    for (std::int32_t e = desk().own.begin + crew_.thread(); e < desk().own.end; e += crew_.threads()) {
      const SolverEntry& entry = desk().entry[e];
      double sum = 0.0;
      for (std::int32_t k = 0; k < entry.count; ++k) sum += s_.push_base[entry.place + k].part[solved_work];
      s_.work_created[entry.body] = sum;
    }
    crew_.barrier();
    if (crew_.block() != 0) return;
    const double sum = summed_work(s_.work_created, s_.work_created, s_.bodies).given;
    if (crew_.thread() == 0) crew_.shared().energy_created = larger(sum, 0.0);
  }

 private:
  GEM_DEVICE const SolverDesk& desk() const { return crew_.shared().desk; }

  GEM_DEVICE static double sum_of_group(const double* terms, std::int32_t count) {
    double eight[8];
    for (int k = 0; k < 8; ++k) {
      double four[4];
      for (int j = 0; j < 4; ++j) four[j] = 4 * k + j < count ? terms[4 * k + j] : 0.0;
      eight[k] = sum_of_four(four);
    }
    return sum_of_eight(eight);
  }

  /// ordered_sum() of the energies of all bodies; every block works it out for itself.
  GEM_DEVICE ImpulseWork summed_work(const double* given, const double* answered, std::int32_t count) {
    const std::int32_t most = (s_.bodies + sum_width - 1) / sum_width;
    double* to = s_.partial_sum + static_cast<std::int64_t>(crew_.block()) * 4 * (most + 1);
    if (count == 0) return {0.0, 0.0};
    do {
      const std::int32_t made = (count + sum_width - 1) / sum_width;
      for (std::int32_t k = crew_.thread(); k < 2 * made; k += crew_.threads()) {
        const std::int32_t first = sum_width * (k < made ? k : k - made);
        to[k] = sum_of_group((k < made ? given : answered) + first, count - first);
      }
      crew_.block_barrier();
      given = to;
      answered = to + made;
      to += 2 * made;
      count = made;
    } while (count > 1);
    const ImpulseWork work{given[0], answered[0]};
    crew_.block_barrier();  // before the memory is used again
    return work;
  }

  const DeviceScene& s_;
  Crew& crew_;
};

}  // namespace gem
