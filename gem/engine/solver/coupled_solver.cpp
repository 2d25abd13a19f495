// Algorithm of one time step with numerics.iteration = "gradient" (splitting/islands.h has that of "splitting"):
//   base: the impulses of the same contact points in the last time step, and the velocities from them
//   rounds until the residual is met, or until the largest number of iterations; each round:
//     iterate from the base, in single precision:
//       visit all points, eight at a time, from the same velocities; each point writes its pushes
//       sum the pushes on each body in the order of its points: the velocities for the next visit
//     add the result of the round to the base
// An iteration has two barriers. No point depends on the order of the others, so there is no graph colouring, and every
// number of threads gives the same bits.
#include "gem/engine/solver/coupled_solver.h"

#include <algorithm>
#include <utility>

#include "gem/engine/solver/iteration_control.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/ordered_sum.h"
#include "gem/engine/step/solo_stages.h"

namespace gem {

void CoupledSolver::restore(std::vector<std::uint64_t> keys, std::vector<PointMemory> memory) {
  keys_ = std::move(keys);
  memory_ = std::move(memory);
}

void CoupledSolver::lay_out(const FieldState& f, Contacts contacts, int threads) {
  thread_residual_.assign(threads, {});
  iterations_ = 0;
  residual_ = 0.0;
  layout_.lay_out(f, contacts, threads);
  make_space(f.constants.iteration);
}

void CoupledSolver::make_space(Iteration iteration) {
  point_.resize(layout_.points());
  spare_.resize(layout_.points());
  next_keys_.resize(layout_.points());
  next_memory_.resize(layout_.points());
  motion_.resize(1 + layout_.bodies());
  motion_[CoupledLayout::at_rest] = {};
  if (iteration == Iteration::splitting) return;
  linear_energy_.resize(layout_.bodies() + sum_width);
  quadratic_energy_.resize(layout_.bodies() + sum_width);
  rounds_.resize(layout_);
}

/// Index of the first key of the last time step, from `at` on, that is not below `key`.
std::size_t CoupledSolver::last_key_from(std::size_t at, std::uint64_t key) const {
  while (at < keys_.size() && keys_[at] < key) ++at;
  return at;
}

/// What a point has carried from the last time step; zero if it did not exist then. `at`: index of the first key of its
/// pair, if there is one.
PointMemory CoupledSolver::memory_of(std::uint64_t key, std::size_t at) const {
  while (at < keys_.size() && keys_[at] != key && keys_[at] >> feature_bits == key >> feature_bits) ++at;
  if (at == keys_.size() || keys_[at] != key) return {};
  return memory_[at];
}

/// Prepares the points of contacts [begin, end).
void CoupledSolver::begin_points(const FieldState& f, Contacts contacts, std::int64_t begin, std::int64_t end) {
  if (begin == end) return;
  const std::uint64_t first = contact_key(contacts[begin]->a, contacts[begin]->b, 0);
  std::size_t at = std::lower_bound(keys_.begin(), keys_.end(), first) - keys_.begin();
  for (std::int64_t c = begin; c < end; ++c) {
    Contact& contact = *contacts[c];
    prefetch_events(f, contacts[std::min(c + 8, end - 1)]->b);
    at = last_key_from(at, contact_key(contact.a, contact.b, 0));
    prepare_contact(f, contact);
    for (int k = 0; k < contact.count; ++k) {
      ContactSlot& slot = contact.slot[k];
      const std::int32_t i = layout_.first_point(c) + k;
      Point& point = point_[i];
      const PointMemory last = memory_of(contact_key(contact.a, contact.b, slot.feature), at);
      recall(f.constants, contact, slot, collision_mass(f.bodies, contact.a), collision_mass(f.bodies, contact.b),
             last);
      spare_[i] = slot.spare;
      point.impulse = last.impulse;
      point.geometry =
          point_of_contact(f, contact, slot, layout_.points_of(contact.a), layout_.points_of(contact.b), last);
      point.impulse.repair = repair_to_go_on(f.constants, point.impulse.repair, point.geometry.nn);
      slot.cap = point.geometry.cap;
      if (f.constants.iteration == Iteration::gradient)
        rounds_.set_geometry(i, point.geometry, layout_.entry_of(contact.a), layout_.entry_of(contact.b));
    }
  }
}

CoupledSolver::Stretch CoupledSolver::stretch_of(const ThreadTeam& team, int rank) const {
  if (team.size() == 1) return {0, layout_.blocks(), 0, layout_.points(), 1, 1 + layout_.bodies()};
  const std::int32_t first_block = layout_.first_block_of(rank), last_block = layout_.first_block_of(rank + 1);
  return {first_block,
          last_block,
          std::min(float_lanes * first_block, layout_.points()),
          std::min(float_lanes * last_block, layout_.points()),
          layout_.first_entry_of(rank),
          layout_.first_entry_of(rank + 1)};
}

/// Sets the velocities of a stretch to those after the impulses of the base.
void CoupledSolver::move_by_base(const FieldState& f, const Stretch& s) {
  const std::uint32_t* const as_b = layout_.points_as_b();
  for (std::int32_t k = s.first_entry; k < s.last_entry; ++k) {
    Push<double> sum{};
    for (std::int32_t at = layout_.begin_as_b(k); at < layout_.begin_as_b(k + 1); ++at) {
      const Point& soon = point_[as_b[at + CoupledLayout::prefetch_padding]];
      __builtin_prefetch(&soon);
      __builtin_prefetch(&soon.geometry.target);
      const Point& p = point_[as_b[at]];
      add(sum, 1.0, push_of(p.geometry, p.impulse, p.geometry.lever_b_n, p.geometry.lever_b_t));
    }
    for (std::int32_t at = layout_.first_as_a(k); at < layout_.end_as_a(k); ++at) {
      const Point& p = point_[at];
      add(sum, -1.0, push_of(p.geometry, p.impulse, p.geometry.lever_a_n, p.geometry.lever_a_t));
    }
    const Bodies& b = f.bodies;
    const std::int32_t i = layout_.body(k);
    motion_[k] = moved_by(sum, b.velocity[i].x, b.velocity[i].y, b.spin[i], b.inverse_mass[i], b.inverse_inertia[i]);
  }
}

/// Scales the impulses of the base by best_share() if that share is below `limit`.
void CoupledSolver::keep_best_share(const FieldState& f, ThreadTeam& team, int rank, const Stretch& s, double limit) {
  const Bodies& b = f.bodies;
  for (std::int32_t k = s.first_entry; k < s.last_entry; ++k) {
    const std::int32_t i = layout_.body(k);
    const EnergyChange change =
        energy_change(motion_[k], b.velocity[i].x, b.velocity[i].y, b.spin[i], b.mass[i], b.inertia[i]);
    linear_energy_[layout_.rank(k)] = change.linear;
    quadratic_energy_[layout_.rank(k)] = change.quadratic;
  }
  team.barrier();
  if (rank == 0)
    share_ = best_share({ordered_sum(linear_energy_.data(), layout_.bodies()),
                         ordered_sum(quadratic_energy_.data(), layout_.bodies())});
  team.barrier();
  if (!(share_ < limit)) return;
  for (std::int32_t i = s.first_point; i < s.last_point; ++i) {
    point_[i].impulse.normal *= share_;
    point_[i].impulse.tangential *= share_;
  }
  team.barrier();
  move_by_base(f, s);
  team.barrier();
}

void CoupledSolver::begin_round(const FieldState& f, ThreadTeam& team, const Stretch& s, bool first) {
  for (std::int32_t i = s.first_point; i < s.last_point; ++i) {
    const Point& p = point_[i];
    rounds_.set_base(i, p.geometry, spare_[i], p.impulse, motion_[rounds_.entry_a(i)], motion_[rounds_.entry_b(i)]);
  }
  if (first) {
    for (std::int32_t k = s.first_entry; k < s.last_entry; ++k) {
      const std::int32_t i = layout_.body(k);
      rounds_.set_body(k, f.bodies.inverse_mass[i], f.bodies.inverse_inertia[i]);
    }
  } else {
    rounds_.push(s.first_block, s.last_block);
    team.barrier();
    rounds_.move(layout_, s.first_entry, s.last_entry);
  }
  team.barrier();
}

void CoupledSolver::end_round(const FieldState& f, const Stretch& s) {
  for (std::int32_t i = s.first_point; i < s.last_point; ++i) {
    Point& p = point_[i];
    p.impulse = rounds_.with_additions(f.constants.point_friction, i, p.geometry, spare_[i], p.impulse);
  }
}

void CoupledSolver::iterate_gradient(const FieldState& f, ThreadTeam& team, int rank) {
  const StepConstants& c = f.constants;
  const StepLength<float> pace{static_cast<float>(c.dt), static_cast<float>(1.0 / c.dt)};
  const Stretch s = stretch_of(team, rank);
  move_by_base(f, s);
  team.barrier();
  keep_best_share(f, team, rank, s, 1.0);
  IterationControl control(c.residual_speed, c.iterations_maximum, c.tight_residual, f.momentum_coefficients.data());
  double residual = 0.0;
  auto next = IterationControl::Next::round;
  while (next != IterationControl::Next::end) {
    begin_round(f, team, s, control.iteration() == 0);
    for (next = IterationControl::Next::iteration; next == IterationControl::Next::iteration;) {
      const float momentum_coefficient = control.momentum_coefficient();
      thread_residual_[rank].speed =
          rounds_.visit(c.point_friction, control.judged(), s.first_block, s.last_block, pace, momentum_coefficient);
      team.barrier();
      if (control.judged()) {
        residual = 0.0;
        for (const ThreadResidual& one : thread_residual_) residual = larger(residual, static_cast<double>(one.speed));
      }
      next = control.after(static_cast<float>(residual));
      if (next != IterationControl::Next::iteration) break;
      rounds_.move(layout_, s.first_entry, s.last_entry);
      team.barrier();
    }
    end_round(f, s);
    team.barrier();
    move_by_base(f, s);
    team.barrier();
  }
  if (rank == 0) {
    iterations_ = static_cast<std::int32_t>(control.iteration());
    residual_ = residual;
  }
  keep_best_share(f, team, rank, s, share_limit(c.point_friction, residual <= c.residual_speed));
}

/// Bodies ascend as in the field, and points as their contacts, for any number of threads.
void CoupledSolver::hand_to_islands(const FieldState& f, Contacts contacts, int threads) {
  const Bodies& b = f.bodies;
  islands_.begin(layout_.bodies(), layout_.points(), threads);
  for (std::int32_t k = 1; k <= layout_.bodies(); ++k) {
    const std::int32_t i = layout_.body(k);
    islands_.set_body(layout_.rank(k),
                      {b.position[i], b.velocity[i], b.spin[i], {b.inverse_mass[i], b.inverse_inertia[i]}});
  }
  const auto rank_of = [&](std::int32_t entry) {
    return entry == CoupledLayout::at_rest ? Islands::fixed : layout_.rank(entry);
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const std::int32_t of_a = rank_of(layout_.entry_of(contacts[c]->a));
    const std::int32_t of_b = rank_of(layout_.entry_of(contacts[c]->b));
    for (int k = 0; k < contacts[c]->count; ++k) {
      const std::int32_t i = layout_.first_point(c) + k;
      islands_.set_point(i, {of_a, of_b, &point_[i].geometry, &point_[i].impulse, spare_[i], k == 0});
    }
  }
  islands_.find();
}

void CoupledSolver::iterate_splitting(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  const StepConstants& c = f.constants;
  team.single(rank, [&] { hand_to_islands(f, contacts, team.size()); });
  islands_.solve({c.point_friction, c.residual_speed, c.dt, c.iterations_maximum, !c.tight_residual}, rank);
  team.barrier();
  move_by_base(f, stretch_of(team, rank));
  team.single(rank, [&] {
    const IslandResult worst = islands_.worst();
    iterations_ = static_cast<std::int32_t>(worst.iterations);
    residual_ = worst.error;
  });
}

void CoupledSolver::hand_back(FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  const auto count = static_cast<std::int64_t>(contacts.size());
  for (std::int64_t c = team.begin_of(rank, count); c < team.begin_of(rank + 1, count); ++c) {
    Contact& contact = *contacts[c];
    for (int k = 0; k < contact.count; ++k) {
      const std::int32_t i = layout_.first_point(c) + k;
      const PointImpulse<double>& p = point_[i].impulse;
      contact.slot[k].impulse = {p.normal, p.tangential};
      contact.slot[k].repair = p.repair;
      next_keys_[i] = contact_key(contact.a, contact.b, contact.slot[k].feature);
      next_memory_[i] = {p, rise_of_load(contact.slot[k].last_normal, p.normal)};
    }
  }
  team.for_each(rank, layout_.bodies(), [&](std::int64_t k) {
    const std::int32_t entry = static_cast<std::int32_t>(k) + 1, i = layout_.body(entry);
    const Motion<double>& m = motion_[entry];
    f.bodies.velocity[i] = {m.x, m.y};
    f.bodies.spin[i] = m.spin;
    apply_repair(f, i, {{m.shift_x, m.shift_y}, m.turn});
  });
}

void CoupledSolver::gather(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  if (contacts.empty()) return;
  const auto count = static_cast<std::int64_t>(contacts.size());
  begin_points(f, contacts, team.begin_of(rank, count), team.begin_of(rank + 1, count));
  team.barrier();
}

void CoupledSolver::iterate_with(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  if (f.constants.iteration == Iteration::splitting)
    iterate_splitting(f, contacts, team, rank);
  else
    iterate_gradient(f, team, rank);
}

void CoupledSolver::iterate(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  if (contacts.empty()) return;
  if (contacts.size() < contacts_worth_a_thread_ * team.size())
    team.single(rank, [&] { iterate_with(f, contacts, alone_, 0); });
  else
    iterate_with(f, contacts, team, rank);
}

void CoupledSolver::settle(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, StepQuality& quality) {
  if (!contacts.empty()) hand_back(f, contacts, team, rank);
  team.single(rank, [&] {
    quality.iterations = iterations_;
    quality.residual = residual_;
    carry_pieces(f);
    keys_.swap(next_keys_);
    memory_.swap(next_memory_);
  });
}

void CoupledSolver::resolve(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, StepQuality& quality) {
  gather(f, contacts, team, rank);
  iterate(f, contacts, team, rank);
  settle(f, contacts, team, rank, quality);
}

}  // namespace gem
