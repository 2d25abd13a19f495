// Algorithm:
//
// - A pair enters the list if it would come closer than the margin within the horizon, with both velocities constant.
//
// - The list is valid while no body has left that straight path by more than half the margin.
//
// - A listed pair is due for the narrow phase once its bodies have moved, relative to each other, by the gap at its
//   last test. Its separating axes are then updated from that test. The due pairs are listed first, without branches,
//   so that their data can be prefetched.
//
// - Most pairs sleep and need not even that check. A clock advances in each time step by twice the distance of the body
//   that moved farthest. A pair sleeps until the clock has advanced by the gap that was left.
#include "gem/engine/cpu/pair_list.h"

#include <algorithm>
#include <cmath>

#include "gem/engine/step/contact_stages.h"

namespace gem {

void PairList::clear() {
  valid_ = false;
  contacts_.clear();
  pairs_.clear();
  axes_.clear();
}

void PairList::note_places(const FieldState& f, ThreadTeam& team, int rank) {
  const double allowed = 0.5 * f.constants.list_margin;
  const double elapsed = static_cast<double>(age_) * f.constants.dt;
  const std::int64_t n = static_cast<std::int64_t>(f.bodies.count());
  const Vec2 drift = f.constants.dt * mean_velocity_;
  bool strayed = false;
  double farthest = 0.0, rim = 0.0;
  for (std::int64_t i = team.begin_of(rank, n); i < team.begin_of(rank + 1, n); ++i) {
    const Place place{f.bodies.position[i], f.bodies.radius[i] * f.turn_travel[i]};
    const Vec2 step = place.position - place_[i].position - drift;
    farthest = std::max(farthest, dot(step, step));
    rim = std::max(rim, place.rim - place_[i].rim);
    place_[i] = place;
    const Vec2 offset = place.position - trajectory_[i].position - elapsed * velocity_[i];
    const double allowed_offset = allowed - (place.rim - trajectory_[i].rim);
    strayed |= f.bodies.active[i] && !(allowed_offset > 0.0 && dot(offset, offset) < allowed_offset * allowed_offset);
  }
  part_[rank].strayed = strayed;
  part_[rank].farthest = std::sqrt(farthest);
  part_[rank].rim = rim;
  team.barrier();
}

std::int64_t PairList::list_waking(std::int64_t begin, std::int64_t end, std::int32_t* waking) const {
  const auto clock = static_cast<float>(clock_);
  std::int64_t count = 0;
  for (std::int64_t i = begin; i < end; ++i) {
    waking[count] = static_cast<std::int32_t>(i);
    count += wake_[i] <= clock;
  }
  return count;
}

void PairList::list_due(std::int64_t begin, std::int64_t end, Part& part) {
  constexpr std::int64_t ahead = 12;  // prefetch distance in pairs, chosen by hand
  std::vector<std::int32_t>& due = part.due;
  if (due.size() < pairs_.size()) due.resize(pairs_.size());
  const std::int64_t waking = list_waking(begin, end, due.data());
  std::int64_t count = 0;
  for (std::int64_t k = 0; k < waking; ++k) {
    __builtin_prefetch(&pairs_[due[std::min(k + 2 * ahead, waking - 1)]]);
    __builtin_prefetch(&place_[pairs_[due[std::min(k + ahead, waking - 1)]].b]);
    const std::int32_t i = due[k];
    const Pair& pair = pairs_[i];
    const Place &a = place_[pair.a], &b = place_[pair.b];
    const double left = pair.free - (a.rim + b.rim);
    const double shifted = length(b.position - a.position - pair.offset);
    wake_[i] = wake_clock(clock_, left - shifted);
    due[count] = i;
    count += !(shifted < left);
  }
  part.due_count = count;
}

bool PairList::touches(const FieldState& f, std::int32_t i, Contact& contact) {
  Pair& pair = pairs_[i];
  FollowedAxes& last = axes_[i];
  const Place &a = place_[pair.a], &b = place_[pair.b];
  if (!f.bodies.active[pair.a] || !f.bodies.active[pair.b]) return false;
  const double limit = f.constants.contact_margin;
  const Vec2 offset = b.position - a.position;
  const double turned_a = f.turn_travel[pair.a], turned_b = f.turn_travel[pair.b];
  // An axis turns with its body and sweeps over the other body. `far` is the distance to the far side of that body.
  const double shifted = length(offset - pair.offset);
  const double far = 2.0 * (f.bodies.radius[pair.a] + f.bodies.radius[pair.b]) + shifted + limit;
  const double moved = shifted + far * (turned_a - last.turned_a + (turned_b - last.turned_b));
  const bool touching = find_contact(f, pair.a, pair.b, last.axes, moved, contact);
  pair.offset = offset;
  pair.free = last.axes.first.distance - limit - motion_rounding + (a.rim + b.rim);
  last.turned_a = turned_a;
  last.turned_b = turned_b;
  return touching;
}

void PairList::find_among(const FieldState& f, const std::int32_t* due, std::int64_t count, Part& part) {
  // prefetch distances chosen by hand; gain in validation/time_step_study.md: 0.87 of the cycles for a million floes
  for (std::int64_t k = 0; k < count; ++k) {
    const auto soon = [&](std::int64_t ahead) { return due[std::min(k + ahead, count - 1)]; };
    __builtin_prefetch(&pairs_[soon(16)]);
    __builtin_prefetch(&axes_[soon(8)]);
    prefetch_search(f, pairs_[soon(8)].b);
    prefetch_outline(f, pairs_[soon(4)].a);
    prefetch_outline(f, pairs_[soon(4)].b);
    if (part.count == part.found.size()) part.found.resize(2 * part.count + 64);
    if (touches(f, due[k], part.found[part.count])) ++part.count;
  }
}

void PairList::find_share(const FieldState& f, const ThreadTeam& team, int rank) {
  std::int64_t all = 0;
  for (int r = 0; r < team.size(); ++r) all += part_[r].due_count;
  std::int64_t begin = team.begin_of(rank, all), end = team.begin_of(rank + 1, all);
  part_[rank].count = 0;
  for (int r = 0; r < team.size(); ++r) {
    const std::int64_t count = part_[r].due_count, first = std::clamp<std::int64_t>(begin, 0, count);
    find_among(f, part_[r].due.data() + first, std::clamp<std::int64_t>(end, 0, count) - first, part_[rank]);
    begin -= count;
    end -= count;
  }
}

void PairList::renew(const FieldState& f, ThreadTeam& team, int rank) {
  team.single(rank, [&] {
    part_.resize(std::max(part_.size(), static_cast<std::size_t>(team.size())));
    for (std::vector<Place>* places : {&place_, &trajectory_}) places->resize(f.bodies.count());
    velocity_.resize(f.bodies.count());
  });
  note_places(f, team, rank);
  team.single(rank, [&] {
    valid_ = valid_ && age_ < horizon_;
    double farthest = 0.0, rim = 0.0;
    for (int r = 0; r < team.size(); ++r) {
      valid_ = valid_ && !part_[r].strayed;
      farthest = std::max(farthest, part_[r].farthest);
      rim = std::max(rim, part_[r].rim);
    }
    clock_ += 2.0 * (farthest + rim);
  });
  if (!valid_) build(f, team, rank);
}

void PairList::choose(ThreadTeam& team, int rank) {
  const auto count = static_cast<std::int64_t>(pairs_.size());
  list_due(team.begin_of(rank, count), team.begin_of(rank + 1, count), part_[rank]);
  team.barrier();
}

void PairList::find_contacts(const FieldState& f, ThreadTeam& team, int rank) {
  Part& mine = part_[rank];
  find_share(f, team, rank);
  team.barrier();
  team.single(rank, [&] {
    ++age_;
    std::size_t count = 0;
    for (int r = 0; r < team.size(); ++r) count += part_[r].count;
    contacts_.resize(count);
  });
  std::size_t at = 0;
  for (int r = 0; r < rank; ++r) at += part_[r].count;
  for (std::size_t i = 0; i < mine.count; ++i) contacts_[at + i] = &mine.found[i];
  team.barrier();
}

void PairList::find(const FieldState& f, ThreadTeam& team, int rank) {
  renew(f, team, rank);
  choose(team, rank);
  find_contacts(f, team, rank);
}

}  // namespace gem
