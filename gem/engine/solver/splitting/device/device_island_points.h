// What both iterations of an island do on a device: motions at the base, what points read and write, sums over points.
#pragma once

#include "gem/engine/solver/device/device_base.h"
#include "gem/engine/solver/splitting/device/device_point_fields.h"
#include "gem/engine/solver/splitting/device/device_team.h"

namespace gem {

GEM_DEVICE inline InverseMass inverse_mass_of(const DeviceScene& s, const PointSide& side) {
  if (side.place < 0) return {};
  const BodyCell& body = s.body[side.body];
  return {body.inverse_mass, body.inverse_inertia};
}

template <class Team>
class DeviceIslandPoints {
 public:
  GEM_DEVICE DeviceIslandPoints(const DeviceScene& s, const Team& team, const TeamMemory& memory)
      : s_(s), team_(team), part_(team.part()), v_(memory.part->view), cell_(*memory.cell) {}

 protected:
  using Atomics = typename Team::Atomics;
  using Part = typename Team::Part;

  GEM_DEVICE const SolverEntry& entry_of(std::int32_t body) const { return s_.solver_entry[v_.m.member[body]]; }

  /// Of the velocities of the island [m/s].
  GEM_DEVICE double tolerance() const { return v_.size().tolerance(s_.constants.residual_speed); }

  /// Notes the end of an island.
  GEM_DEVICE void note(std::int64_t iterations, double error) {
    if (team_.rank() != 0) return;
    Atomics::highest(&s_.island.counters->iterations, static_cast<std::uint32_t>(iterations));
    if (!(error <= 0.0)) Atomics::highest(&s_.island.counters->error_bits, strict::bits_of(error));
  }

  /// Sets the motions of the bodies after the impulses of the base.
  GEM_DEVICE void move_by_base() {
    each_of(team_, 0, v_.bodies, [&](std::int32_t i) {
      const SolverEntry& entry = entry_of(i);
      Push<double> sum{};
      for (std::int32_t k = 0; k < entry.count; ++k) {
        const PushBase& p = s_.push_base[entry.place + k];
        add(sum, k < entry.as_b ? 1.0 : -1.0,
            Push<double>{p.part[0], p.part[1], p.part[4], p.part[2], p.part[3], p.part[5]});
      }
      const BodyCell& b = s_.body[entry.body];
      const Motion<double> m = moved_by(sum, b.velocity.x, b.velocity.y, b.spin, b.inverse_mass, b.inverse_inertia);
      s_.solved[entry.body] = {{m.x, m.y, m.shift_x, m.shift_y, m.spin, m.turn, 0.0, 0.0}};
    });
    team_.sync();
  }

  GEM_DEVICE Motion<double> motion_of(const PointSide& side) const {
    if (side.place < 0) return {};
    const SolvedMotion& m = s_.solved[side.body];
    return {m.part[0], m.part[1], m.part[4], m.part[2], m.part[3], m.part[5]};
  }

  /// Adds the answers of all points to the base, and moves the bodies by it.
  template <class Point>
  GEM_DEVICE void add_to_base() {
    each_of(team_, 0, v_.points, [&](std::int32_t k) {
      const std::int32_t i = v_.m.where[k].taken;
      const PointGeometry<double> g = s_.points.geometry(i);
      write_base(s_, i, s_.taken_point[i], g,
                 with_answer(load_point<Point>(v_, k), 0, s_.constants.point_friction, g, s_.points.spare(i),
                             s_.points.impulse(i)));
    });
    team_.sync();
    move_by_base();
  }

  GEM_DEVICE void load(std::int32_t place, int half, float* motion) const {
    for (int c = 0; c < 3; ++c) motion[c] = place < 0 ? 0.0F : v_.m.now[2 * place + half].part[c];
  }

  /// Writes what a point asks of both bodies.
  template <class Point>
  GEM_DEVICE void write_push(const IslandPointEnds& at, const Point& q, int half, PointShare<float> share) const {
    const auto write = [&](std::int32_t record, const float* n, const float* t) {
      if (record < 0) return;
      FloatQuad push{};
      for (int c = 0; c < 3; ++c) push.part[c] = n[c] * share.n + t[c] * share.t;
      v_.m.push[2 * static_cast<std::int64_t>(record) + half] = push;
    };
    write(at.record_b, q.n_b, q.t_b);
    write(at.record_a, q.n_a, q.t_a);
  }

  /// Adds what the points of a body ask for, in the order of its records.
  GEM_DEVICE void add_pushes(const BodyRecords& records, int half, FloatQuad& sum) const {
    constexpr int together = 4;
    const FloatQuad* const push = v_.m.push + 2 * static_cast<std::int64_t>(records.first) + half;
    for (std::int32_t k = 0; k < records.count; k += together) {
      FloatQuad some[together];
      for (int j = 0; j < together; ++j) some[j] = k + j < records.count ? push[2 * (k + j)] : FloatQuad{};
      for (int j = 0; j < together; ++j)
        if (k + j < records.count)
          for (int c = 0; c < 3; ++c) sum.part[c] += some[j].part[c];
    }
  }

  /// Raises a number of all threads to the largest of theirs; all call it.
  GEM_DEVICE void raise_to(std::uint32_t* bits, float x) const {
    const std::uint32_t most = part_.warp().highest(x > 0.0F ? ordered_bits(x) : 0U);
    if (most > 0 && part_.warp().rank() == 0) Atomics::highest(bits, most);
  }

  const DeviceScene& s_;
  const Team& team_;
  const Part part_;
  const IslandView& v_;
  IslandCell& cell_;
};

}  // namespace gem
