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

constexpr std::int32_t looked_ahead = 12;  // faces asked for before they are needed
constexpr std::int32_t at_rest = 0;        // entry of the motions that never moves: fixed bodies and unused lanes

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

/// Enters the moving bodies in motion_. Within stretches, those with as many points stand together: the loops over a
/// body's points then end as the processor foresees.
void CoupledSolver::order_bodies(const FieldState& f) {
  constexpr std::int32_t stretch = 512, kinds = 256;
  const auto kind = [this](std::int32_t i) {
    const std::int32_t as_b = points_as_b_[i], as_a = points_of_[i] - as_b;
    return 16 * std::min(as_b, 15) + std::min(as_a, 15);
  };
  moving_.clear();
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(f.bodies.count()); ++i)
    if (points_of_[i] > 0 && f.bodies.inverse_mass[i] > 0.0) moving_.push_back(i);
  const auto count = static_cast<std::int32_t>(moving_.size());
  body_.resize(1 + count);
  rank_.resize(1 + count);
  for (std::int32_t first = 0; first < count; first += stretch) {
    const std::int32_t last = std::min(first + stretch, count);
    std::int32_t next[kinds + 1] = {};
    for (std::int32_t j = first; j < last; ++j) ++next[kind(moving_[j]) + 1];
    for (std::int32_t k = 0; k < kinds; ++k) next[k + 1] += next[k];
    for (std::int32_t j = first; j < last; ++j) {
      const std::int32_t at = 1 + first + next[kind(moving_[j])]++;
      body_[at] = moving_[j];
      rank_[at] = j;
    }
  }
  index_of_.assign(f.bodies.count(), at_rest);
  begin_as_b_.assign(2, 0);
  motion_.assign(1, BodyMotion{});
  start_.assign(1, BodyStart{});
  for (std::int32_t k = 1; k <= count; ++k) {
    const std::int32_t i = body_[k];
    index_of_[i] = k;
    begin_as_b_.push_back(begin_as_b_.back() + points_as_b_[i]);
    const double share = points_of_[i], mass = f.bodies.inverse_mass[i], inertia = f.bodies.inverse_inertia[i];
    motion_.push_back(BodyMotion{Pack{0.0, 0.0, 0.0, share * mass}, Pack{0.0, 0.0, 0.0, share * inertia}});
    start_.push_back(BodyStart{Pack{f.bodies.velocity[i].x, f.bodies.velocity[i].y, f.bodies.spin[i], 0.0},
                               Pack{mass, mass, inertia, 0.0}});
  }
}

void CoupledSolver::lay_out(const FieldState& f, Contacts contacts) {
  points_of_.assign(f.bodies.count(), 0);
  points_as_b_.assign(f.bodies.count(), 0);
  first_point_.resize(contacts.size());
  std::int32_t points = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    first_point_[c] = points;
    points += contacts[c]->count;
    points_of_[contacts[c]->a] += contacts[c]->count;
    points_of_[contacts[c]->b] += contacts[c]->count;
    points_as_b_[contacts[c]->b] += contacts[c]->count;
  }
  order_bodies(f);
  const std::int32_t unused = static_cast<std::int32_t>(motion_.size());
  motion_.push_back(BodyMotion{Pack{0.0, 0.0, 0.0, 1.0}, Pack{}});
  first_as_a_.assign(body_.size(), 0);
  end_as_a_.assign(body_.size(), 0);
  next_as_b_.assign(begin_as_b_.begin(), begin_as_b_.end());
  as_b_.assign(begin_as_b_.back() + looked_ahead, 0);

  const std::int32_t blocks = (points + pack_lanes - 1) / pack_lanes;
  face_.resize(static_cast<std::size_t>(blocks) * pack_lanes);
  block_.resize(blocks);
  impulse_.resize(blocks);
  carried_.resize(blocks);
  given_.resize(body_.size() + sum_width);
  answered_.resize(body_.size() + sum_width);
  next_keys_.resize(points);
  next_impulses_.resize(points);
  climb_.resize((static_cast<std::size_t>(points) / sum_width + 1) * sum_width);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const std::int32_t a = index_of_[contacts[c]->a], b = index_of_[contacts[c]->b];
    const std::int32_t end = first_point_[c] + contacts[c]->count;
    if (end_as_a_[a] == 0) first_as_a_[a] = first_point_[c];
    end_as_a_[a] = end;
    if (b == at_rest) continue;
    for (std::int32_t point = first_point_[c]; point < end; ++point)
      as_b_[next_as_b_[b]++] = static_cast<std::uint32_t>(point);
  }
  for (std::int32_t point = points; point < blocks * pack_lanes; ++point) {
    Block& block = block_[point / pack_lanes];
    const int lane = point % pack_lanes;
    face_[point] = Face{};
    block.cap[lane] = block.repair_target[lane] = 0.0;
    BlockImpulse& impulse = impulse_[point / pack_lanes];
    impulse.normal[lane] = impulse.tangential[lane] = impulse.repair[lane] = 0.0;
    block.a[lane] = block.b[lane] = unused;
  }
}

/// First of the last moment's keys from `at` on that is not below `key`.
std::size_t CoupledSolver::last_key_from(std::size_t at, std::uint64_t key) const {
  while (at < keys_.size() && keys_[at] < key) ++at;
  return at;
}

/// `at`: where the last moment's keys of this pair begin, if it has any.
void CoupledSolver::warm_start(const Contact& contact, std::int32_t first, std::size_t at) {
  for (int k = 0; k < contact.count; ++k) {
    const std::uint64_t key = contact_key(contact.a, contact.b, contact.slot[k].feature);
    std::size_t i = at;
    while (i < keys_.size() && keys_[i] != key && keys_[i] >> feature_bits == key >> feature_bits) ++i;
    const bool known = i < keys_.size() && keys_[i] == key;
    const PointImpulse<double> last = known ? impulses_[i] : PointImpulse<double>{};
    BlockImpulse& impulse = impulse_[(first + k) / pack_lanes];
    const int lane = (first + k) % pack_lanes;
    impulse.normal[lane] = last.normal;
    impulse.tangential[lane] = last.tangential;
    impulse.repair[lane] = repair_memory * last.repair;
  }
}

void CoupledSolver::fill_points(const FieldState& f, Contact& contact, std::int32_t first) {
  prepare_contact(f, contact);
  for (int k = 0; k < contact.count; ++k) {
    const std::int32_t point = first + k;
    const int lane = point % pack_lanes;
    const PointGeometry<double> g = point_of_contact(f, contact, contact.slot[k], points_of_[contact.a],
                                                     points_of_[contact.b], impulse_[point / pack_lanes].normal[lane]);
    contact.slot[k].cap = g.cap;
    face_[point] = Face{Pack{g.normal_x, g.normal_y, g.lever_a_n, g.lever_a_t},
                        Pack{g.lever_b_n, g.lever_b_t, g.target, g.friction}};
    Block& block = block_[point / pack_lanes];
    block.cap[lane] = g.cap;
    block.repair_target[lane] = g.repair_target;
    block.a[lane] = index_of_[contact.a];
    block.b[lane] = index_of_[contact.b];
  }
}

/// Makes the points of some contacts ready. A block may hold points of two threads: each writes its own lanes.
void CoupledSolver::begin_range(const FieldState& f, Contacts contacts, std::int64_t begin, std::int64_t end) {
  if (begin == end) return;
  const std::uint64_t first = contact_key(contacts[begin]->a, contacts[begin]->b, 0);
  std::size_t at = std::lower_bound(keys_.begin(), keys_.end(), first) - keys_.begin();
  for (std::int64_t c = begin; c < end; ++c) {
    Contact& contact = *contacts[c];
    at = last_key_from(at, contact_key(contact.a, contact.b, 0));
    warm_start(contact, first_point_[c], at);
    fill_points(f, contact, first_point_[c]);
  }
}

template <PointFriction law>
GEM_INLINE void CoupledSolver::visit_range(std::int32_t begin, std::int32_t end, double dt, double ahead, int rank) {
  const auto read_motion = [this](const std::int32_t* at, Pack& mass, Pack& turn) __attribute__((always_inline)) {
    const BodyMotion &p = motion_[at[0]], &q = motion_[at[1]], &r = motion_[at[2]], &s = motion_[at[3]];
    Motion<Pack> m{p.linear, q.linear, r.linear, p.repair, q.repair, r.repair};
    mass = s.linear;
    turn = s.repair;
    transpose(m.x, m.y, m.spin, mass);
    transpose(m.shift_x, m.shift_y, m.turn, turn);
    return m;
  };
  Pack most{};
  for (std::int32_t i = begin; i < end; ++i) {
    const Block& block = block_[i];
    Pack mass_a, mass_b, turn_a, turn_b;
    const Motion<Pack> a = read_motion(block.a, mass_a, turn_a), b = read_motion(block.b, mass_b, turn_b);
    const Face* face = &face_[pack_lanes * i];
    PointGeometry<Pack> g;
    g.normal_x = face[0].side_a, g.normal_y = face[1].side_a, g.lever_a_n = face[2].side_a,
    g.lever_a_t = face[3].side_a;
    g.lever_b_n = face[0].side_b, g.lever_b_t = face[1].side_b, g.target = face[2].side_b, g.friction = face[3].side_b;
    transpose(g.normal_x, g.normal_y, g.lever_a_n, g.lever_a_t);
    transpose(g.lever_b_n, g.lever_b_t, g.target, g.friction);
    g.cap = block.cap;
    g.repair_target = block.repair_target;
    // cheaper worked out again than read
    enter_compliance(g, mass_a + mass_b, turn_a, turn_b);
    if constexpr (law == PointFriction::fixed_direction) g.nn = g.nn + g.friction * g.nt;
    g.inverse_nn = 1.0 / g.nn;
    if constexpr (law == PointFriction::coulomb) g.inverse_tt = 1.0 / g.tt;
    const PointResidual<Pack> residual = visit_point<law>(g, a, b, dt, 1.0 / dt, ahead, impulse_[i], carried_[i]);
    most = larger(residual.speed, most);
    for (int lane = 0; lane < pack_lanes; ++lane) climb_[pack_lanes * i + lane] = residual.climb[lane];
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

GEM_CLONES void CoupledSolver::move_bodies(const Impulses& impulses, std::int32_t begin, std::int32_t end) {
  const Face* const faces = face_.data();
  struct Given {
    Pack push, repair;
  };
  // push_of() with its fields in lanes; `side` holds the normal and the levers, its last lane gives nothing of use
  const auto given = [&impulses](const Pack& side, std::uint32_t point) __attribute__((always_inline)) {
    const PointImpulse<Pack>& p = impulses[point / pack_lanes];
    const unsigned lane = point % pack_lanes;
    const Pack across = __builtin_shuffle(side, PackMask{1, 0, 3, 3}) * Pack{-1.0, 1.0, 1.0, 1.0};
    return Given{p.normal[lane] * side + p.tangential[lane] * across, p.repair[lane] * side};
  };
  for (std::int32_t k = begin; k < end; ++k) {
    Pack push{}, repair{};
    for (std::int32_t s = begin_as_b_[k]; s < begin_as_b_[k + 1]; ++s) {
      __builtin_prefetch(&faces[as_b_[s + looked_ahead]]);
      const Face& face = faces[as_b_[s]];
      const Given from = given(__builtin_shuffle(face.side_a, face.side_b, PackMask{0, 1, 4, 5}), as_b_[s]);
      push += from.push;
      repair += from.repair;
    }
    const auto end_as_a = static_cast<std::uint32_t>(end_as_a_[k]);
    for (auto point = static_cast<std::uint32_t>(first_as_a_[k]); point < end_as_a; ++point) {
      const Given from = given(faces[point].side_a, point);
      push -= from.push;
      repair -= from.repair;
    }
    // moved_by() with its fields in lanes
    const BodyStart& start = start_[k];
    BodyMotion& motion = motion_[k];
    constexpr PackMask last_of_second{0, 1, 2, 7};
    motion.linear = __builtin_shuffle(start.velocity + start.answer * push, motion.linear, last_of_second);
    motion.repair = __builtin_shuffle(start.answer * repair, motion.repair, last_of_second);
  }
}

void CoupledSolver::weigh_impulses(const FieldState& f, std::int32_t begin, std::int32_t end) {
  const Bodies& b = f.bodies;
  for (std::int32_t k = begin; k < end; ++k) {
    const std::int32_t i = body_[k];
    const Pack& m = motion_[k].linear;
    const ImpulseWork work = work_on_body({m[0], m[1], m[2], 0.0, 0.0, 0.0}, b.velocity[i].x, b.velocity[i].y,
                                          b.spin[i], b.mass[i], b.inertia[i]);
    given_[rank_[k]] = work.given;
    answered_[rank_[k]] = work.answered;
  }
}

void CoupledSolver::scale_impulses(std::int32_t begin, std::int32_t end, double share) {
  for (std::int32_t i = begin; i < end; ++i) {
    impulse_[i].normal *= share;
    impulse_[i].tangential *= share;
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
    move_bodies(impulse_, first_body, last_body);
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
    team.barrier();
    settle();
  };
  settle();
  keep_best_share(1.0);
  for (std::int32_t i = first_block; i < last_block; ++i) carried_[i] = impulse_[i];
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
    move_bodies(carried_, first_body, last_body);
    if (rank == 0) climb_sum_ = ordered_sum(climb_.data(), pack_lanes * block_.size());
    team.barrier();
  }
}

void CoupledSolver::hand_back(FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  team.for_each(rank, static_cast<std::int64_t>(contacts.size()), [&](std::int64_t c) {
    Contact& contact = *contacts[c];
    for (int k = 0; k < contact.count; ++k) {
      const std::int32_t point = first_point_[c] + k;
      const PointImpulse<Pack>& p = impulse_[point / pack_lanes];
      const int lane = point % pack_lanes;
      contact.slot[k].impulse = {p.normal[lane], p.tangential[lane]};
      contact.slot[k].repair = p.repair[lane];
      next_keys_[point] = contact_key(contact.a, contact.b, contact.slot[k].feature);
      next_impulses_[point] = {p.normal[lane], p.tangential[lane], p.repair[lane]};
    }
  });
  team.for_each(rank, static_cast<std::int64_t>(body_.size()) - 1, [&](std::int64_t k) {
    const std::int32_t i = body_[k + 1];
    const BodyMotion& m = motion_[k + 1];
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
  });
  if (team.failed()) return;
  if (!contacts.empty()) {
    const auto count = static_cast<std::int64_t>(contacts.size());
    begin_range(f, contacts, team.begin_of(rank, count), team.begin_of(rank + 1, count));
    team.barrier();
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
    keys_.swap(next_keys_);
    impulses_.swap(next_impulses_);
  });
}

}  // namespace gem
