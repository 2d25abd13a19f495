// Algorithm of one moment:
//   start from the impulses that the same contact points carried a moment ago
//   repeat: visit all points, four at a time, from the same velocities; each writes what it gives to its two bodies
//           add up what each body was given, in the order of its points: the velocities for the next visits
//   until no point asks for more than the stated residual, or the bound on iterations is reached
// Two waits an iteration, no order among the points, no colours: the same bits for any number of threads.
#include "gem/engine/coupled_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gem/engine/contact_stages.h"
#include "gem/engine/ordered_sum.h"

namespace gem {
namespace {

// the same bits with wider registers: no fused multiply-add among them
#define GEM_CLONES __attribute__((target_clones("avx2", "default")))

constexpr std::int32_t at_rest = 0;  // entry of the motions that never moves: fixed bodies and unused lanes

/// Turns four entries with fields in lanes into four packs with entries in lanes.
GEM_INLINE void transpose(Pack& p, Pack& q, Pack& r, Pack& s) {
  const PackMask low{0, 4, 2, 6}, high{1, 5, 3, 7}, first{0, 1, 4, 5}, second{2, 3, 6, 7};
  const Pack pq_low = __builtin_shuffle(p, q, low), pq_high = __builtin_shuffle(p, q, high);
  const Pack rs_low = __builtin_shuffle(r, s, low), rs_high = __builtin_shuffle(r, s, high);
  p = __builtin_shuffle(pq_low, rs_low, first);
  q = __builtin_shuffle(pq_high, rs_high, first);
  r = __builtin_shuffle(pq_low, rs_low, second);
  s = __builtin_shuffle(pq_high, rs_high, second);
}

}  // namespace

void CoupledSolver::restore(std::vector<std::uint64_t> keys, std::vector<PointImpulse<double>> impulses) {
  keys_ = std::move(keys);
  impulses_ = std::move(impulses);
}

void CoupledSolver::lay_out(const FieldState& f, Contacts contacts) {
  const Bodies& b = f.bodies;
  const auto moves = [&](std::int32_t i) { return b.inverse_mass[i] > 0.0; };
  points_of_.assign(b.count(), 0);
  first_point_.resize(contacts.size());
  std::int32_t points = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    first_point_[c] = points;
    points += contacts[c]->count;
    points_of_[contacts[c]->a] += contacts[c]->count;
    points_of_[contacts[c]->b] += contacts[c]->count;
  }
  index_of_.assign(b.count(), at_rest);
  body_.assign(1, -1);
  push_begin_.assign(2, 0);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(b.count()); ++i) {
    if (points_of_[i] == 0 || !moves(i)) continue;
    index_of_[i] = static_cast<std::int32_t>(body_.size());
    body_.push_back(i);
    push_begin_.push_back(push_begin_.back() + points_of_[i]);
  }
  const std::int32_t blocks = (points + pack_lanes - 1) / pack_lanes;
  block_.assign(blocks, Block{});
  motion_.assign(body_.size(), Slot{});
  push_.resize(2 * static_cast<std::size_t>(blocks) * pack_lanes);
  given_.resize(body_.size() + sum_width);
  answered_.resize(body_.size() + sum_width);
  climb_.resize((static_cast<std::size_t>(points) / sum_width + 1) * sum_width);
  // where each side of a point leaves its push: the moving bodies' in the order of the points, all others behind
  std::vector<std::int32_t>& next = next_push_;
  next.assign(push_begin_.begin(), push_begin_.end());
  std::int32_t unused = push_begin_.back();
  std::int32_t point = 0;
  const auto place = [&](std::int32_t body) {
    const std::int32_t index = index_of_[body];
    return index == at_rest ? unused++ : next[index]++;
  };
  for (const Contact* contact : contacts)
    for (int k = 0; k < contact->count; ++k, ++point) {
      Block& block = block_[point / pack_lanes];
      const int lane = point % pack_lanes;
      block.a[lane] = index_of_[contact->a];
      block.b[lane] = index_of_[contact->b];
      block.push_a[lane] = place(contact->a);
      block.push_b[lane] = place(contact->b);
    }
  for (; point < blocks * pack_lanes; ++point) {
    block_[point / pack_lanes].push_a[point % pack_lanes] = unused++;
    block_[point / pack_lanes].push_b[point % pack_lanes] = unused++;
  }
}

void CoupledSolver::warm_start(Contacts contacts) {
  std::size_t at = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = *contacts[c];
    const std::uint64_t first = contact_key(contact.a, contact.b, 0);
    while (at < keys_.size() && keys_[at] < first) ++at;
    for (int k = 0; k < contact.count; ++k) {
      const std::uint64_t key = contact_key(contact.a, contact.b, contact.slot[k].feature);
      for (std::size_t i = at; i < keys_.size() && keys_[i] >> feature_bits == key >> feature_bits; ++i) {
        if (keys_[i] != key) continue;
        const std::int32_t point = first_point_[c] + k;
        Block& block = block_[point / pack_lanes];
        const int lane = point % pack_lanes;
        block.impulse.normal[lane] = impulses_[i].normal;
        block.impulse.tangential[lane] = impulses_[i].tangential;
        block.impulse.repair[lane] = repair_memory * impulses_[i].repair;
      }
    }
  }
}

void CoupledSolver::keep(Contacts contacts) {
  keys_.clear();
  impulses_.clear();
  for (const Contact* contact : contacts)
    for (int k = 0; k < contact->count; ++k) {
      const ContactSlot& slot = contact->slot[k];
      keys_.push_back(contact_key(contact->a, contact->b, slot.feature));
      impulses_.push_back({slot.impulse.normal, slot.impulse.tangential, slot.repair});
    }
}

void CoupledSolver::fill_points(const FieldState& f, Contact& contact, std::int32_t first) {
  prepare_contact(f, contact);
  for (int k = 0; k < contact.count; ++k) {
    Block& block = block_[(first + k) / pack_lanes];
    const int lane = (first + k) % pack_lanes;
    const PointGeometry<double> g = point_of_contact(f, contact, contact.slot[k], points_of_[contact.a],
                                                     points_of_[contact.b], block.impulse.normal[lane]);
    contact.slot[k].cap = g.cap;
    PointGeometry<Pack>& to = block.geometry;
    to.normal_x[lane] = g.normal_x;
    to.normal_y[lane] = g.normal_y;
    to.lever_a_n[lane] = g.lever_a_n;
    to.lever_a_t[lane] = g.lever_a_t;
    to.lever_b_n[lane] = g.lever_b_n;
    to.lever_b_t[lane] = g.lever_b_t;
    to.nn[lane] = g.nn;
    to.tt[lane] = g.tt;
    to.nt[lane] = g.nt;
    to.inverse_nn[lane] = g.inverse_nn;
    to.inverse_tt[lane] = g.inverse_tt;
    to.target[lane] = g.target;
    to.friction[lane] = g.friction;
    to.cap[lane] = g.cap;
    to.repair_target[lane] = g.repair_target;
  }
}

template <class Block, class Slot>
GEM_INLINE static void write_pushes(const Block& block, const PointImpulse<Pack>& impulse, Slot* push) {
  const PointGeometry<Pack>& g = block.geometry;
  Pack unused{};
  for (int side = 0; side < 2; ++side) {
    Push<Pack> p =
        side == 0 ? push_of(g, impulse, g.lever_a_n, g.lever_a_t) : push_of(g, impulse, g.lever_b_n, g.lever_b_t);
    if (side == 0) p = {-p.x, -p.y, -p.twist, -p.shift_x, -p.shift_y, -p.turn};
    const std::int32_t* to = side == 0 ? block.push_a : block.push_b;
    Pack u = unused, v = unused;
    transpose(p.x, p.y, p.twist, u);
    transpose(p.shift_x, p.shift_y, p.turn, v);
    push[to[0]] = {p.x, p.shift_x};
    push[to[1]] = {p.y, p.shift_y};
    push[to[2]] = {p.twist, p.turn};
    push[to[3]] = {u, v};
  }
}

template <class Slot>
GEM_INLINE static Motion<Pack> read_motions(const Slot* motion, const std::int32_t* at) {
  Pack x = motion[at[0]].linear, y = motion[at[1]].linear, spin = motion[at[2]].linear, u = motion[at[3]].linear;
  transpose(x, y, spin, u);
  Pack shift_x = motion[at[0]].repair, shift_y = motion[at[1]].repair, turn = motion[at[2]].repair,
       v = motion[at[3]].repair;
  transpose(shift_x, shift_y, turn, v);
  return {x, y, spin, shift_x, shift_y, turn};
}

template <PointFriction law>
GEM_INLINE void CoupledSolver::visit_range(std::int32_t begin, std::int32_t end, double dt, double ahead, int rank) {
  Pack most{};
  for (std::int32_t i = begin; i < end; ++i) {
    Block& block = block_[i];
    const Motion<Pack> a = read_motions(motion_.data(), block.a), b = read_motions(motion_.data(), block.b);
    const PointResidual<Pack> residual =
        visit_point<law>(block.geometry, a, b, dt, 1.0 / dt, ahead, block.impulse, block.carried);
    most = larger(residual.speed, most);
    for (int lane = 0; lane < pack_lanes; ++lane) climb_[pack_lanes * i + lane] = residual.climb[lane];
    write_pushes(block, block.carried, push_.data());
  }
  most_[rank].speed = larger(larger(most[0], most[1]), larger(most[2], most[3]));
}

GEM_CLONES void CoupledSolver::visit_frictionless(std::int32_t begin, std::int32_t end, double dt, double ahead,
                                                  int rank) {
  visit_range<PointFriction::none>(begin, end, dt, ahead, rank);
}

GEM_CLONES void CoupledSolver::visit_coulomb(std::int32_t begin, std::int32_t end, double dt, double ahead, int rank) {
  visit_range<PointFriction::coulomb>(begin, end, dt, ahead, rank);
}

GEM_CLONES void CoupledSolver::visit_fixed_direction(std::int32_t begin, std::int32_t end, double dt, double ahead,
                                                     int rank) {
  visit_range<PointFriction::fixed_direction>(begin, end, dt, ahead, rank);
}

GEM_CLONES void CoupledSolver::push_blocks(std::int32_t begin, std::int32_t end) {
  for (std::int32_t i = begin; i < end; ++i) write_pushes(block_[i], block_[i].impulse, push_.data());
}

GEM_CLONES void CoupledSolver::move_bodies(const FieldState& f, std::int32_t begin, std::int32_t end) {
  const Bodies& bodies = f.bodies;
  for (std::int32_t k = begin; k < end; ++k) {
    Pack linear{}, repair{};
    for (std::int32_t s = push_begin_[k]; s < push_begin_[k + 1]; ++s) {
      linear += push_[s].linear;
      repair += push_[s].repair;
    }
    const std::int32_t i = body_[k];
    const double mass = bodies.inverse_mass[i], inertia = bodies.inverse_inertia[i];
    const Motion<double> m = moved_by(Push<double>{linear[0], linear[1], linear[2], repair[0], repair[1], repair[2]},
                                      bodies.velocity[i].x, bodies.velocity[i].y, bodies.spin[i], mass, inertia);
    motion_[k] = {Pack{m.x, m.y, m.spin, 0.0}, Pack{m.shift_x, m.shift_y, m.turn, 0.0}};
  }
}

void CoupledSolver::weigh_impulses(const FieldState& f, std::int32_t begin, std::int32_t end) {
  const Bodies& b = f.bodies;
  for (std::int32_t k = begin; k < end; ++k) {
    const std::int32_t i = body_[k];
    const Pack& m = motion_[k].linear;
    const ImpulseWork work = work_on_body({m[0], m[1], m[2], 0.0, 0.0, 0.0}, b.velocity[i].x, b.velocity[i].y,
                                          b.spin[i], b.mass[i], b.inertia[i]);
    given_[k - 1] = work.given;
    answered_[k - 1] = work.answered;
  }
}

void CoupledSolver::scale_impulses(std::int32_t begin, std::int32_t end, double share) {
  for (std::int32_t i = begin; i < end; ++i) {
    block_[i].impulse.normal *= share;
    block_[i].impulse.tangential *= share;
  }
}

void CoupledSolver::iterate(const FieldState& f, ThreadTeam& team, int rank) {
  const MomentConstants& c = f.constants;
  const std::int64_t blocks = static_cast<std::int64_t>(block_.size());
  const std::int64_t bodies = static_cast<std::int64_t>(body_.size()) - 1;
  const auto first_block = static_cast<std::int32_t>(team.begin_of(rank, blocks));
  const auto last_block = static_cast<std::int32_t>(team.begin_of(rank + 1, blocks));
  const auto first_body = static_cast<std::int32_t>(1 + team.begin_of(rank, bodies));
  const auto last_body = static_cast<std::int32_t>(1 + team.begin_of(rank + 1, bodies));
  const auto settle = [&] {
    push_blocks(first_block, last_block);
    team.barrier();
    move_bodies(f, first_body, last_body);
    team.barrier();
  };
  const auto keep_best_share = [&](double limit) {
    weigh_impulses(f, first_body, last_body);
    team.barrier();
    if (rank == 0)
      share_ =
          best_share({ordered_sum(given_.data(), body_.size() - 1), ordered_sum(answered_.data(), body_.size() - 1)});
    team.barrier();
    if (!(share_ < limit)) return;
    scale_impulses(first_block, last_block, share_);
    settle();
  };
  settle();
  keep_best_share(1.0);
  for (std::int32_t i = first_block; i < last_block; ++i) block_[i].carried = block_[i].impulse;
  const auto visit = c.point_friction == PointFriction::none      ? &CoupledSolver::visit_frictionless
                     : c.point_friction == PointFriction::coulomb ? &CoupledSolver::visit_coulomb
                                                                  : &CoupledSolver::visit_fixed_direction;
  Acceleration acceleration;
  for (std::int32_t iteration = 1;; ++iteration) {
    (this->*visit)(first_block, last_block, c.dt, acceleration.next(climb_sum_ > 0.0), rank);
    team.barrier();
    double residual = 0.0;
    for (const Most& most : most_) residual = larger(residual, most.speed);
    if (residual <= c.residual_speed || iteration >= c.iterations_maximum) {
      if (rank == 0) {
        iterations_ = iteration;
        residual_ = residual;
      }
      settle();
      keep_best_share(0.5);
      return;
    }
    move_bodies(f, first_body, last_body);
    if (rank == 0) climb_sum_ = ordered_sum(climb_.data(), pack_lanes * block_.size());
    team.barrier();
  }
}

void CoupledSolver::hand_back(FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  team.for_each(rank, static_cast<std::int64_t>(contacts.size()), [&](std::int64_t c) {
    Contact& contact = *contacts[c];
    for (int k = 0; k < contact.count; ++k) {
      const std::int32_t point = first_point_[c] + k;
      const PointImpulse<Pack>& p = block_[point / pack_lanes].impulse;
      const int lane = point % pack_lanes;
      contact.slot[k].impulse = {p.normal[lane], p.tangential[lane]};
      contact.slot[k].repair = p.repair[lane];
    }
  });
  team.for_each(rank, static_cast<std::int64_t>(body_.size()) - 1, [&](std::int64_t k) {
    const std::int32_t i = body_[k + 1];
    const Slot& m = motion_[k + 1];
    f.bodies.velocity[i] = {m.linear[0], m.linear[1]};
    f.bodies.spin[i] = m.linear[2];
    f.repair_shift[i] = {m.repair[0], m.repair[1]};
    f.repair_turn[i] = m.repair[2];
  });
}

void CoupledSolver::resolve(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, MomentQuality& quality) {
  team.single(rank, [&] {
    most_.assign(team.size(), {});
    iterations_ = 0;
    residual_ = 0.0;
    climb_sum_ = 0.0;
    lay_out(f, contacts);
    warm_start(contacts);
  });
  if (team.failed()) return;
  if (!contacts.empty()) {
    // a block may hold points of two threads' contacts: each writes its own lanes
    team.for_each(rank, static_cast<std::int64_t>(contacts.size()),
                  [&](std::int64_t c) { fill_points(f, *contacts[c], first_point_[c]); });
    if (contacts.size() < contacts_worth_threads_) {
      team.single(rank, [&] { iterate(f, alone_, 0); });
    } else {
      iterate(f, team, rank);
    }
    hand_back(f, contacts, team, rank);
  }
  team.single(rank, [&] {
    quality.iterations = iterations_;
    quality.residual = residual_;
    keep(contacts);
  });
}

}  // namespace gem
