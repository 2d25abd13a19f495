// The fronts of an island on a device: which bodies each front joins, and where its numbers stand. The same as
// FrontFactor::analyse(), level by level.
#pragma once

#include "gem/engine/solver/splitting/device_dissection.h"

namespace gem {

/// First of `count` ascending numbers that is not below `wanted`.
GEM_DEVICE inline std::int32_t lower_place(const std::int32_t* from, std::int32_t count, std::int32_t wanted) {
  std::int32_t begin = 0;
  while (count > 0) {
    const std::int32_t half = count / 2;
    if (from[begin + half] < wanted) {
      begin += half + 1;
      count -= half + 1;
    } else {
      count = half;
    }
  }
  return begin;
}

/// First row of a body in the columns of a front: own rows first.
GEM_DEVICE inline std::int32_t row_in(const IslandView& v, const IslandNode& f, std::int32_t place) {
  if (place < f.end) return 3 * (place - f.own);
  return f.own_rows() + 3 * lower_place(v.m.other + f.first_other, f.others, place);
}

template <class Team>
class FrontFinder {
 public:
  /// `scene`: the memory of the scene.
  GEM_DEVICE FrontFinder(const Team& team, IslandView& view, const IslandMemory& scene, const TeamMemory& memory)
      : team_(team), v_(view), scene_(scene), memory_(memory) {}

  /// Sets the fronts, and the island's part of the slots and numbers. Returns false if they do not fit in the scene's
  /// memory.
  GEM_DEVICE bool find() {
    each_of(team_, 0, v_.bodies, [&](std::int32_t p) { v_.m.place[v_.m.order[p]] = p; });
    team_.sync();
    for (std::int32_t level = v_.levels; level-- > 0;) {
      each_of(team_, v_.first_node(level), v_.first_node(level + 1), [&](std::int32_t id) { draft_others(id); });
      team_.sync();
    }
    if (memory_.cell->overflow) return false;
    place_nodes();
    if (memory_.cell->overflow) return false;
    each_of(team_, 0, v_.slots, [&](std::int32_t t) {
      const IslandNode& f = v_.m.node[v_.m.front[t]];
      v_.m.row_above[t] = row_in(v_, v_.m.node[f.parent], v_.m.other[t]);
    });
    sort_parts();
    return true;
  }

 private:
  using Atomics = typename Team::Atomics;

  /// The others of a front, ascending: those of its children, and later bodies in contact with its own.
  GEM_DEVICE void draft_others(std::int32_t id) {
    IslandNode& f = v_.m.node[id];
    IslandNode none;
    const IslandNode& left = f.child >= 0 ? v_.m.node[f.child] : none;
    const IslandNode& right = f.child >= 0 ? v_.m.node[f.child + 1] : none;
    std::int32_t most = left.others + right.others;
    for (std::int32_t p = f.own; p < f.end; ++p)
      v_.graph.each_neighbour(v_.m.order[p], [&](std::int32_t body) { most += v_.m.place[body] >= f.end ? 1 : 0; });
    f.draft = most > 0 ? Atomics::add(&scene_.counters->drafts, most) : 0;
    f.others = 0;
    if (f.draft + most > scene_.slots_capacity) {
      Atomics::add(&memory_.cell->overflow, 1);
      return;
    }
    std::int32_t* const to = scene_.draft + f.draft;
    std::int32_t count = 0;
    for (std::int32_t i = 0, j = 0; i < left.others || j < right.others;) {
      const std::int32_t none_left = v_.bodies;
      const std::int32_t p = i < left.others ? scene_.draft[left.draft + i] : none_left;
      const std::int32_t q = j < right.others ? scene_.draft[right.draft + j] : none_left;
      const std::int32_t next = p < q ? p : q;
      i += p == next ? 1 : 0;
      j += q == next ? 1 : 0;
      if (next >= f.end) to[count++] = next;
    }
    for (std::int32_t p = f.own; p < f.end; ++p)
      v_.graph.each_neighbour(v_.m.order[p], [&](std::int32_t body) {
        const std::int32_t place = v_.m.place[body];
        if (place < f.end) return;
        const std::int32_t at = lower_place(to, count, place);
        if (at < count && to[at] == place) return;
        for (std::int32_t k = count; k > at; --k) to[k] = to[k - 1];
        to[at] = place;
        ++count;
      });
    f.others = count;
  }

  /// Gives each node its slots, its own places and its numbers, in the order of the nodes.
  GEM_DEVICE void place_nodes() {
    const TeamShare mine = share_of(team_, 0, v_.nodes);
    TeamCount count;
    std::int64_t numbers = 0;
    for (std::int32_t id = mine.begin; id < mine.end; ++id) {
      IslandNode& f = v_.m.node[id];
      count.part[0] += f.others;
      count.part[1] += f.end - f.own;
      f.numbers = 0;
      numbers += f.end_of_numbers();
    }
    count.part[2] = static_cast<std::int32_t>(numbers);  // below 2^31: else the capacity is exceeded
    const TeamSums sums = sum_over(team_, memory_.count, count);
    IslandCell& cell = *memory_.cell;
    if (team_.rank() == 0) {
      cell.slots = sums.all.part[0];
      cell.first_slot = Atomics::add(&scene_.counters->slots, cell.slots);
      cell.numbers = static_cast<std::uint64_t>(sums.all.part[2]);
      cell.first_number = Atomics::add(&scene_.counters->numbers, cell.numbers);
      if (cell.first_slot + cell.slots > scene_.slots_capacity ||
          cell.first_number + cell.numbers > scene_.numbers_capacity)
        cell.overflow = 1;
      v_.slots = cell.slots;
      v_.m.other += cell.first_slot;
      v_.m.front += cell.first_slot;
      v_.m.row_above += cell.first_slot;
      v_.m.unsorted += cell.first_slot;
      v_.m.sorted += cell.first_slot;
      v_.m.product += 2 * static_cast<std::int64_t>(cell.first_slot);
      v_.m.numbers += cell.first_number;
    }
    team_.sync();
    if (cell.overflow) return;
    std::int32_t slot = sums.below.part[0], own = sums.below.part[1];
    std::int64_t number = sums.below.part[2];
    for (std::int32_t id = mine.begin; id < mine.end; ++id) {
      IslandNode& f = v_.m.node[id];
      f.first_other = slot;
      f.first_own = own;
      f.numbers = number;
      slot += f.others;
      own += f.end - f.own;
      number = f.end_of_numbers();
      for (std::int32_t k = 0; k < f.others; ++k) {
        v_.m.other[f.first_other + k] = scene_.draft[f.draft + k];
        v_.m.front[f.first_other + k] = id;
      }
      for (std::int32_t p = f.own; p < f.end; ++p) v_.m.own_place[f.first_own + p - f.own] = p;
    }
    team_.sync();
  }

  /// Whether the host's solver eliminates front `a` before `b`, two fronts below one body.
  GEM_DEVICE bool comes_before(std::int32_t a, std::int32_t b) const {
    const IslandNode &f = v_.m.node[a], &g = v_.m.node[b];
    if (f.own != g.own) return f.own < g.own;
    const bool own_f = f.end > f.own, own_g = g.end > g.own;
    return own_f != own_g ? own_g : f.depth > g.depth;
  }

  /// Lists the slots of each body in the order in which its sums are made.
  GEM_DEVICE void sort_parts() {
    each_of(team_, 0, v_.bodies, [&](std::int32_t p) { v_.m.parts_in[p] = v_.m.filled_in[p] = 0; });
    team_.sync();
    each_of(team_, 0, v_.slots, [&](std::int32_t t) { Atomics::add(&v_.m.parts_in[v_.m.other[t]], 1); });
    team_.sync();
    const TeamShare mine = share_of(team_, 0, v_.bodies);
    TeamCount count;
    for (std::int32_t p = mine.begin; p < mine.end; ++p) count.part[0] += v_.m.parts_in[p];
    std::int32_t first = sum_over(team_, memory_.count, count).below.part[0];
    for (std::int32_t p = mine.begin; p < mine.end; ++p) {
      v_.m.first_in[p] = first;
      first += v_.m.parts_in[p];
    }
    team_.sync();
    each_of(team_, 0, v_.slots, [&](std::int32_t t) {
      const std::int32_t p = v_.m.other[t];
      v_.m.unsorted[v_.m.first_in[p] + Atomics::add(&v_.m.filled_in[p], 1)] = t;
    });
    team_.sync();
    each_of(team_, 0, v_.slots, [&](std::int32_t k) {
      const std::int32_t t = v_.m.unsorted[k], p = v_.m.other[t], begin = v_.m.first_in[p];
      std::int32_t before = 0;
      for (std::int32_t j = begin; j < begin + v_.m.parts_in[p]; ++j)
        before += comes_before(v_.m.front[v_.m.unsorted[j]], v_.m.front[t]) ? 1 : 0;
      v_.m.sorted[begin + before] = t;
    });
    team_.sync();
  }

  const Team& team_;
  IslandView& v_;
  const IslandMemory& scene_;
  const TeamMemory& memory_;
};

}  // namespace gem
