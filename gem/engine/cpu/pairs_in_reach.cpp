#include "gem/engine/cpu/pairs_in_reach.h"

#include <algorithm>
#include <utility>

#include "gem/engine/contact/platform_substep.h"
#include "gem/engine/step/contact_stages.h"

namespace gem {
namespace {

/// How far two bodies may close in a time step, from their present motion and what drives them [m]. It tells which
/// corners share the mass of a body, so it hangs on nothing distant; others are seen too when a neighbour is hit.
double reach_of(const FieldState& f, std::int32_t a, std::int32_t b) {
  const Bodies& s = f.bodies;
  const double closing =
      length(s.velocity[b] - s.velocity[a]) + magnitude(s.spin[a]) * s.radius[a] + magnitude(s.spin[b]) * s.radius[b];
  return f.constants.dt * (closing + f.constants.drive_speed);
}

}  // namespace

void PairsInReach::note_velocities(const FieldState& f) {
  velocity_before_ = f.bodies.velocity;
  spin_before_ = f.bodies.spin;
}

Surface PairsInReach::surface_of(const FieldState& f, std::int32_t body) const {
  const std::uint8_t* hidden = nullptr;
  if (!hidden_side_.empty() && f.constants.is_platform(body)) hidden = &hidden_side_[f.bodies.vertex_begin[body]];
  return {f.outline(body), hidden};
}

void PairsInReach::find_corners(const FieldState& f, Contacts contacts, const ThreadTeam& team, int rank) {
  std::vector<CornerInReach>& found = part_[rank].corner;
  found.clear();
  const auto n = static_cast<std::int64_t>(contacts.size());
  for (std::int64_t c = team.begin_of(rank, n); c < team.begin_of(rank + 1, n); ++c) {
    const Contact& contact = *contacts[c];
    const double near = reach_of(f, contact.a, contact.b), reach = f.constants.contact_margin;
    const auto take = [&](bool of_b, std::int32_t corner, SideDistance outer) {
      const CornerInReach one{static_cast<std::int32_t>(c), corner, outer.side, of_b, outer.distance < near};
      const std::int32_t p = one.p(contact);
      if (!no_corner_.empty() && f.constants.is_platform(p) && no_corner_[f.bodies.vertex_begin[p] + corner]) return;
      found.push_back(one);
    };
    const Outline a = f.outline(contact.a), b = f.outline(contact.b);
    const Vec2 offset = f.bodies.position[contact.b] - f.bodies.position[contact.a], axis = contact.normal;
    double top = -1e300, bottom = 1e300;  // of a and of b along the axis
    for (int k = 0; k < a.count; ++k) top = larger(top, dot(axis, a.corner[k]));
    for (int k = 0; k < b.count; ++k) bottom = smaller(bottom, dot(axis, offset + b.corner[k]));
    if (!(bottom - top < reach)) continue;
    corners_near(b, surface_of(f, contact.a), offset, axis, top + reach, reach,
                 [&](std::int32_t corner, SideDistance outer) { take(true, corner, outer); });
    corners_near(a, surface_of(f, contact.b), -offset, -axis, dot(axis, offset) - bottom + reach, reach,
                 [&](std::int32_t corner, SideDistance outer) { take(false, corner, outer); });
  }
}

std::int32_t PairsInReach::enter(const FieldState& f, std::int32_t body, std::int64_t substeps) {
  std::int32_t& entry = entry_of_[body];
  if (entry >= 0) return entry;
  entry = static_cast<std::int32_t>(body_.size());
  const Bodies& b = f.bodies;
  SubBody s;
  s.inverse_mass = b.inverse_mass[body];
  s.inverse_inertia = b.inverse_inertia[body];
  s.mass = b.mass[body];
  s.inertia = b.inertia[body];
  s.start_velocity = velocity_before_[body];
  s.start_spin = spin_before_[body];
  s.radius = b.radius[body] + f.constants.contact_margin;
  if (b.kind[body] == BodyKind::floe) {
    const double share = 1.0 / static_cast<double>(substeps);
    s.kick = share * (b.velocity[body] - velocity_before_[body]);
    s.kick_spin = share * (b.spin[body] - spin_before_[body]);
  }
  body_.push_back(s);
  body_id_.push_back(body);
  share_.push_back(0);
  return entry;
}

/// Pairs and bodies in order of the contacts, whichever thread found the corners.
void PairsInReach::lay_out(const FieldState& f, Contacts contacts, std::int64_t substeps, int threads) {
  for (const std::int32_t body : body_id_) entry_of_[body] = -1;
  entry_of_.resize(f.bodies.count(), -1);
  corner_.clear();
  pair_.clear();
  body_.clear();
  body_id_.clear();
  share_.clear();
  for (int r = 0; r < threads; ++r) corner_.insert(corner_.end(), part_[r].corner.begin(), part_[r].corner.end());
  const auto bodies_of = [&](const CornerInReach& one) {
    const Contact& contact = *contacts[one.contact];
    return std::pair(f.constants.owner_of(contact.a), contact.b);
  };
  // what a body has with several pieces of the platform is one contact
  if (f.constants.pieces > 1)
    std::stable_sort(corner_.begin(), corner_.end(),
                     [&](const CornerInReach& a, const CornerInReach& b) { return bodies_of(a) < bodies_of(b); });
  for (std::size_t k = 0; k < corner_.size(); ++k) {
    if (k == 0 || bodies_of(corner_[k]) != bodies_of(corner_[k - 1])) {
      pair_.push_back({});
      pair_.back().first = static_cast<std::int32_t>(k);
      pair_.back().contact = corner_[k].contact;
    }
    ++pair_.back().count;
  }
  platform_ = f.constants.events.platform_present ? enter(f, 0, substeps) : -1;
  for (PairInReach& pair : pair_) {
    const Contact& contact = *contacts[pair.contact];
    pair.a = enter(f, f.constants.owner_of(contact.a), substeps);
    pair.b = enter(f, contact.b, substeps);
    for (std::int32_t k = pair.first; k < pair.first + pair.count; ++k) {
      share_[pair.a] += corner_[k].counts;
      share_[pair.b] += corner_[k].counts;
    }
  }
}

void PairsInReach::watch_pair(const FieldState& f, Contacts contacts, double h, PairInReach& pair) {
  for (std::int32_t k = pair.first; k < pair.first + pair.count; ++k) {
    const CornerInReach& one = corner_[k];
    const Contact& contact = *contacts[one.contact];
    const std::int32_t p = one.p(contact), q = one.q(contact);
    const Outline sides = f.outline(q);
    const Vec2 corner = f.outline(p).corner[one.corner], normal = sides.normal[one.side];
    const Vec2 arm_q = start_of(f, p) - start_of(f, q) + corner;
    watch(pair.watch, body_[one.of_b ? pair.b : pair.a], body_[one.of_b ? pair.a : pair.b], corner, arm_q, normal,
          dot(normal, arm_q - sides.corner[one.side]), h);
  }
  pair.watch.gap -= motion_rounding;
}

void PairsInReach::find(const FieldState& f, Contacts contacts, std::int64_t substeps, ThreadTeam& team, int rank) {
  team.single(rank, [&] {
    part_.resize(std::max(part_.size(), static_cast<std::size_t>(team.size())));
    if (f.piece_corner.empty() || !hidden_side_.empty()) return;
    hidden_side_.resize(f.piece_corner.size());
    no_corner_.resize(f.piece_corner.size());
    find_hidden(f, hidden_side_, no_corner_);
  });
  find_corners(f, contacts, team, rank);
  team.barrier();
  team.single(rank, [&] { lay_out(f, contacts, substeps, team.size()); });
  const double h = f.constants.dt / static_cast<double>(substeps);
  team.for_each(rank, static_cast<std::int64_t>(pair_.size()),
                [&](std::int64_t i) { watch_pair(f, contacts, h, pair_[i]); });
}

}  // namespace gem
