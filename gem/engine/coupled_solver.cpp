// Algorithm of one moment:
//   start from the impulses that the same contact points carried a moment ago
//   repeat: visit the contacts of bodies that just changed, colour by colour; each takes the impulse its law asks for
//           given all others; then move the platform by the sum of its contacts' impulses
//   until a visit to every contact changes no speed by more than the stated residual, or the bound on sweeps is reached
//   sweep the position repair the same way
// Contacts of one colour share no moving body, so their order cannot matter; the platform, which would need a colour
// for each of its contacts, is held still within a sweep and lends each contact point an equal share of its mass.
#include "gem/engine/coupled_solver.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "gem/base/error.h"
#include "gem/engine/contact_stages.h"

namespace gem {
namespace {

/// Platform velocity from the sum of all its contacts' impulses, in contact order.
void move_platform(FieldState& f, Contacts contacts, Vec2 velocity, double spin, std::int32_t sweep) {
  Vec2 impulse;
  double twist = 0.0;
  for (const Contact* at : contacts) {
    const Contact& contact = *at;
    if (contact.a != 0) break;
    for (int k = 0; k < contact.count; ++k) {
      const ContactSlot& slot = contact.slot[k];
      const Vec2 p = slot.impulse.normal * contact.normal + slot.impulse.tangential * turned_left(contact.normal);
      impulse += p;
      twist += cross(slot.arm_a, p);
    }
  }
  place_platform(f, velocity - f.bodies.inverse_mass[0] * impulse, spin - f.bodies.inverse_inertia[0] * twist, sweep);
}

void shift_platform(FieldState& f, Contacts contacts) {
  Vec2 impulse;
  double twist = 0.0;
  for (const Contact* at : contacts) {
    const Contact& contact = *at;
    if (contact.a != 0) break;
    for (int k = 0; k < contact.count; ++k) {
      const Vec2 p = contact.slot[k].repair * contact.normal;
      impulse += p;
      twist += cross(contact.slot[k].arm_a, p);
    }
  }
  f.repair_shift[0] = -(f.bodies.inverse_mass[0] * impulse);
  f.repair_turn[0] = -(f.bodies.inverse_inertia[0] * twist);
}

double platform_points(Contacts contacts) {
  int points = 0;
  for (const Contact* at : contacts) {
    const Contact& contact = *at;
    if (contact.a != 0) break;
    points += contact.count;
  }
  return points;
}

}  // namespace

void CoupledSolver::restore(std::vector<std::uint64_t> keys, std::vector<Vec2> impulses) {
  keys_ = std::move(keys);
  impulses_ = std::move(impulses);
}

void CoupledSolver::warm_start(Contacts contacts) const {
  std::size_t at = 0;
  for (Contact* found : contacts) {
    Contact& contact = *found;
    const std::uint64_t first = contact_key(contact.a, contact.b, 0);
    while (at < keys_.size() && keys_[at] < first) ++at;
    for (int k = 0; k < contact.count; ++k) {
      const std::uint64_t key = contact_key(contact.a, contact.b, contact.slot[k].feature);
      for (std::size_t i = at; i < keys_.size() && keys_[i] >> feature_bits == key >> feature_bits; ++i)
        if (keys_[i] == key) contact.slot[k].impulse = {impulses_[i].x, impulses_[i].y};
    }
  }
}

void CoupledSolver::keep(Contacts contacts) {
  keys_.clear();
  impulses_.clear();
  for (const Contact* contact : contacts)
    for (int k = 0; k < contact->count; ++k) {
      keys_.push_back(contact_key(contact->a, contact->b, contact->slot[k].feature));
      impulses_.push_back({contact->slot[k].impulse.normal, contact->slot[k].impulse.tangential});
    }
}

void CoupledSolver::colour(const FieldState& f, Contacts contacts) {
  used_.assign(f.bodies.count(), 0);
  colour_of_.resize(contacts.size());
  std::int32_t count[64] = {};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = *contacts[i];
    const bool a_moves = sweeps_write_a(f.bodies, contact);
    const bool b_moves = f.bodies.inverse_mass[contact.b] > 0.0;
    const std::uint64_t taken = (a_moves ? used_[contact.a] : 0) | (b_moves ? used_[contact.b] : 0);
    if (taken == ~std::uint64_t{0})
      throw Error(ExitCode::numerical_stop, "a floe touches more than 64 others at once (overlapping field)");
    const int colour = std::countr_one(taken);
    if (a_moves) used_[contact.a] |= std::uint64_t{1} << colour;
    if (b_moves) used_[contact.b] |= std::uint64_t{1} << colour;
    colour_of_[i] = static_cast<std::uint8_t>(colour);
    ++count[colour];
  }
  colour_begin_.assign(1, 0);
  for (int c = 0; c < 64 && count[c] > 0; ++c) colour_begin_.push_back(colour_begin_.back() + count[c]);
  order_.resize(contacts.size());
  std::vector<std::int32_t> next(colour_begin_.begin(), colour_begin_.end());
  for (std::size_t i = 0; i < contacts.size(); ++i) order_[next[colour_of_[i]]++] = contacts[i];
}

template <class Visit>
void CoupledSolver::sweep(ThreadTeam& team, int rank, Visit&& visit) {
  for (std::size_t c = 0; c + 1 < colour_begin_.size(); ++c) {
    const std::int32_t begin = colour_begin_[c];
    team.for_each(rank, colour_begin_[c + 1] - begin, [&](std::int64_t i) { visit(*order_[begin + i]); });
  }
}

void CoupledSolver::start_moment(FieldState& f, Contacts contacts) {
  colour(f, contacts);
  platform_velocity_ = f.bodies.velocity[0];
  platform_spin_ = f.bodies.spin[0];
  std::fill(f.changed.begin(), f.changed.end(), 0);
  sweeps_ = contacts.empty() ? 0 : 1;
  residual_ = 0.0;
  all_ = true;
  done_ = contacts.empty();
}

void CoupledSolver::end_sweep(FieldState& f, Contacts contacts) {
  move_platform(f, contacts, platform_velocity_, platform_spin_, sweeps_);
  residual_ = 0.0;
  for (const Change& change : change_) residual_ = std::max(residual_, change.speed);
  const bool settled = residual_ <= f.constants.residual_speed;
  done_ = (settled && all_) || sweeps_ >= f.constants.iterations_maximum;
  all_ = settled;  // what looks settled is looked over once more in full
  if (!done_) ++sweeps_;
}

void CoupledSolver::sweep_to_residual(FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  sweep(team, rank, [&](Contact& contact) { apply_impulses(f.bodies, contact, sweeps_write_a(f.bodies, contact)); });
  team.single(rank, [&] { move_platform(f, contacts, platform_velocity_, platform_spin_, 0); });
  while (!done_) {
    double change = 0.0;
    sweep(team, rank, [&](Contact& contact) {
      if (all_ || wants_visit(f, contact, sweeps_)) change = std::max(change, resolve_together(f, contact, sweeps_));
    });
    change_[rank].speed = change;
    team.barrier();
    team.single(rank, [&] { end_sweep(f, contacts); });
  }
  for (std::int64_t i = 0; i < f.constants.repair_iterations; ++i) {
    sweep(team, rank, [&](Contact& contact) { repair_overlap(f, contact); });
    team.single(rank, [&] { shift_platform(f, contacts); });
  }
}

void CoupledSolver::resolve(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, MomentQuality& quality) {
  const double share = platform_points(contacts);
  team.single(rank, [&] {
    change_.assign(team.size(), {});
    warm_start(contacts);
    start_moment(f, contacts);
  });
  if (team.failed()) return;
  team.for_each(rank, static_cast<std::int64_t>(contacts.size()),
                [&](std::int64_t i) { prepare_contact(f, *contacts[i], share); });
  if (contacts.size() < contacts_worth_threads_) {
    team.single(rank, [&] { sweep_to_residual(f, contacts, alone_, 0); });
  } else {
    sweep_to_residual(f, contacts, team, rank);
  }
  team.single(rank, [&] {
    quality.iterations = sweeps_;
    quality.residual = residual_;
    keep(contacts);
  });
}

}  // namespace gem
