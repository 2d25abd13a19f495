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

/// Below this many contacts a second thread costs more than it brings.
constexpr std::size_t contacts_worth_threads = 256;

struct PlatformStart {
  Vec2 velocity;
  double spin = 0.0;
};

/// Platform velocity from the sum of all its contacts' impulses, in contact order.
void move_platform(FieldState& f, const std::vector<Contact>& contacts, const PlatformStart& start,
                   std::int32_t sweep) {
  Vec2 impulse;
  double twist = 0.0;
  for (const Contact& contact : contacts) {
    if (contact.a != 0) break;
    for (int k = 0; k < contact.count; ++k) {
      const ContactSlot& slot = contact.slot[k];
      const Vec2 p = slot.impulse.normal * contact.normal + slot.impulse.tangential * turned_left(contact.normal);
      impulse += p;
      twist += cross(slot.arm_a, p);
    }
  }
  place_platform(f, start.velocity - f.bodies.inverse_mass[0] * impulse,
                 start.spin - f.bodies.inverse_inertia[0] * twist, sweep);
}

void shift_platform(FieldState& f, const std::vector<Contact>& contacts) {
  Vec2 impulse;
  double twist = 0.0;
  for (const Contact& contact : contacts) {
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

double platform_points(const std::vector<Contact>& contacts) {
  int points = 0;
  for (const Contact& contact : contacts) {
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

void CoupledSolver::warm_start(std::vector<Contact>& contacts) const {
  std::size_t at = 0;
  for (Contact& contact : contacts) {
    const std::uint64_t first = contact_key(contact.a, contact.b, 0);
    while (at < keys_.size() && keys_[at] < first) ++at;
    for (int k = 0; k < contact.count; ++k) {
      const std::uint64_t key = contact_key(contact.a, contact.b, contact.slot[k].feature);
      for (std::size_t i = at; i < keys_.size() && keys_[i] >> 8 == key >> 8; ++i)
        if (keys_[i] == key) contact.slot[k].impulse = {impulses_[i].x, impulses_[i].y};
    }
  }
}

void CoupledSolver::keep(const std::vector<Contact>& contacts) {
  keys_.clear();
  impulses_.clear();
  for (const Contact& contact : contacts)
    for (int k = 0; k < contact.count; ++k) {
      keys_.push_back(contact_key(contact.a, contact.b, contact.slot[k].feature));
      impulses_.push_back({contact.slot[k].impulse.normal, contact.slot[k].impulse.tangential});
    }
}

void CoupledSolver::colour(const FieldState& f, const std::vector<Contact>& contacts) {
  used_.assign(f.bodies.count(), 0);
  colour_of_.resize(contacts.size());
  std::int32_t count[64] = {};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
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
  for (std::size_t i = 0; i < contacts.size(); ++i) order_[next[colour_of_[i]]++] = static_cast<std::int32_t>(i);
}

void CoupledSolver::resolve(FieldState& f, std::vector<Contact>& contacts, int threads, MomentQuality& quality) {
  const double share = platform_points(contacts);
  for (Contact& contact : contacts) prepare_contact(f, contact, share);
  colour(f, contacts);
  warm_start(contacts);
  const PlatformStart start{f.bodies.velocity[0], f.bodies.spin[0]};
  const std::size_t colours = colour_begin_.size() - 1;
  if (contacts.size() < contacts_worth_threads) threads = 1;
  double residual = 0.0;
  std::int32_t sweeps = contacts.empty() ? 0 : 1;
  bool done = contacts.empty(), all = true;
  std::fill(f.changed.begin(), f.changed.end(), 0);

#pragma omp parallel num_threads(threads)
  {
    // visits every contact, a colour at a time; the loop's own barrier parts the colours
    auto sweep = [&](auto&& visit) {
      for (std::size_t c = 0; c < colours; ++c) {
#pragma omp for schedule(static)
        for (std::int32_t i = colour_begin_[c]; i < colour_begin_[c + 1]; ++i) visit(contacts[order_[i]]);
      }
    };
    sweep([&](Contact& contact) { apply_impulses(f.bodies, contact, sweeps_write_a(f.bodies, contact)); });
#pragma omp single
    move_platform(f, contacts, start, 0);
    while (!done) {
      double change = 0.0;
      sweep([&](Contact& contact) {
        if (all || wants_visit(f, contact, sweeps)) change = std::max(change, resolve_together(f, contact, sweeps));
      });
#pragma omp single
      residual = 0.0;
#pragma omp critical
      residual = std::max(residual, change);
#pragma omp barrier
#pragma omp single
      {
        move_platform(f, contacts, start, sweeps);
        const bool settled = residual <= f.constants.residual_speed;
        done = (settled && all) || sweeps >= f.constants.iterations_maximum;
        all = settled;  // what looks settled is looked over once more in full
        if (!done) ++sweeps;
      }
    }
    for (std::int64_t i = 0; i < f.constants.repair_iterations; ++i) {
      sweep([&](Contact& contact) { repair_overlap(f, contact); });
#pragma omp single
      shift_platform(f, contacts);
    }
  }
  quality.iterations = sweeps;
  quality.residual = residual;
  keep(contacts);
}

}  // namespace gem
