// The fronts of an island on a device: which bodies each front joins, and where its numbers stand. The same as
// FrontFactor::analyse(), level by level: first those of the branches, then those of the trunk.
#pragma once

#include "gem/engine/solver/splitting/device/device_dissection.h"
#include "gem/engine/solver/splitting/solve_tiles.h"

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

/// Finds the fronts of the trunk or of a branch, by the threads of a block or a warp. Between its functions all threads
/// of the island have to meet.
template <class Team>
class FrontFinder {
 public:
  GEM_DEVICE FrontFinder(const Team& team, TreePart& part, const IslandView& view, IslandCell& cell,
                         const TeamMemory& memory)
      : team_(team), p_(part), v_(view), m_(view.m), cell_(cell), memory_(memory) {}

  /// Sets the fronts, and the part's own slots and numbers. Raises the island's overflow if they do not fit in the
  /// scene's memory. The fronts below are set, and the places of all bodies. Threads decide by the part's own overflow:
  /// another block may raise the island's at any time.
  GEM_DEVICE void find() {
    for (std::int32_t level = p_.levels; level-- > 0;) {
      each_node(level, [&](std::int32_t id) { draft_others(id); });
      team_.sync();
    }
    if (p_.overflow == 0) place_nodes();
    team_.sync();
    if (team_.rank() == 0 && p_.overflow != 0) Atomics::add(&cell_.overflow, 1);
  }

  /// Sets the rows of the others in the fronts above, which are set, and counts the slots of the bodies.
  GEM_DEVICE void count_parts() {
    each_slot([&](std::int32_t t) {
      const IslandNode& f = m_.node[m_.front[t]];
      m_.row_above[t] = row_in(v_, m_.node[f.parent], m_.other[t]);
      Atomics::add(&m_.parts_in[m_.other[t]], 1);
    });
  }
  /// Gives the bodies their ranges of sorted slots.
  GEM_DEVICE void place_parts() {
    const TeamShare mine = share_of(team_, p_.first_own, p_.first_own + p_.owns);
    TeamCount count;
    for (std::int32_t k = mine.begin; k < mine.end; ++k) count.part[0] += m_.parts_in[m_.own_place[k]];
    const TeamSums sums = sum_over<1>(team_, memory_.count, count);
    if (team_.rank() == 0) {
      p_.sorted = sums.all.part[0];
      p_.first_sorted = Atomics::add(&m_.counters->sorted, p_.sorted);
    }
    team_.sync();
    std::int32_t first = p_.first_sorted + sums.below.part[0];
    for (std::int32_t k = mine.begin; k < mine.end; ++k) {
      const std::int32_t place = m_.own_place[k];
      m_.first_in[place] = first;
      first += m_.parts_in[place];
    }
  }
  GEM_DEVICE void fill_parts() {
    each_slot([&](std::int32_t t) {
      const std::int32_t p = m_.other[t];
      m_.unsorted[m_.first_in[p] + Atomics::add(&m_.filled_in[p], 1)] = t;
    });
  }
  /// Sorts the slots of each body into the order in which its sums are made.
  GEM_DEVICE void sort_parts() {
    each_of(team_, p_.first_sorted, p_.first_sorted + p_.sorted, [&](std::int32_t k) {
      const std::int32_t t = m_.unsorted[k], p = m_.other[t], begin = m_.first_in[p];
      std::int32_t before = 0;
      for (std::int32_t j = begin; j < begin + m_.parts_in[p]; ++j)
        before += comes_before(m_.front[m_.unsorted[j]], m_.front[t]) ? 1 : 0;
      m_.sorted[begin + before] = t;
    });
  }

 private:
  using Atomics = typename Team::Atomics;

  template <class Work>
  GEM_DEVICE void each_node(std::int32_t level, Work&& work) {
    each_of(team_, m_.level[p_.level + level].node, m_.level[p_.level + level + 1].node, work);
  }
  template <class Work>
  GEM_DEVICE void each_slot(Work&& work) {
    each_of(team_, p_.first_slot, p_.first_slot + p_.slots, work);
  }

  /// The others of a front, ascending: those of its children, and later bodies in contact with its own.
  GEM_DEVICE void draft_others(std::int32_t id) {
    IslandNode& f = m_.node[id];
    IslandNode none;
    const IslandNode& left = f.child[0] >= 0 ? m_.node[f.child[0]] : none;
    const IslandNode& right = f.child[1] >= 0 ? m_.node[f.child[1]] : none;
    std::int32_t most = left.others + right.others;
    for (std::int32_t p = f.own; p < f.end; ++p)
      v_.graph.each_neighbour(m_.order[p], [&](std::int32_t body) { most += m_.place[body] >= f.end ? 1 : 0; });
    f.draft = most > 0 ? Atomics::add(&m_.counters->drafts, most) : 0;
    f.others = 0;
    if (f.draft < 0 || f.draft > m_.slots_capacity - most) {
      Atomics::add(&p_.overflow, 1);
      return;
    }
    std::int32_t* const to = m_.draft + f.draft;
    std::int32_t count = 0;
    for (std::int32_t i = 0, j = 0; i < left.others || j < right.others;) {
      const std::int32_t none_left = v_.bodies;
      const std::int32_t p = i < left.others ? m_.draft[left.draft + i] : none_left;
      const std::int32_t q = j < right.others ? m_.draft[right.draft + j] : none_left;
      const std::int32_t next = p < q ? p : q;
      i += p == next ? 1 : 0;
      j += q == next ? 1 : 0;
      if (next >= f.end) to[count++] = next;
    }
    for (std::int32_t p = f.own; p < f.end; ++p)
      v_.graph.each_neighbour(m_.order[p], [&](std::int32_t body) {
        const std::int32_t place = m_.place[body];
        if (place < f.end) return;
        const std::int32_t at = lower_place(to, count, place);
        if (at < count && to[at] == place) return;
        for (std::int32_t k = count; k > at; --k) to[k] = to[k - 1];
        to[at] = place;
        ++count;
      });
    f.others = count;
  }

  GEM_DEVICE static TileShape forth_shape(const IslandNode& f) {
    return tile_shape(f.owns() > 0 ? f.others : 0, f.owns(), Team::Warp::size);
  }
  GEM_DEVICE static TileShape back_shape(const IslandNode& f) {
    return tile_shape(f.owns(), f.owns() + f.others, Team::Warp::size);
  }

  /// Gives each node its slots, its own places, its tiles and its numbers, in the order of the nodes.
  GEM_DEVICE void place_nodes() {
    const TeamShare mine = share_of(team_, p_.first_node, p_.first_node + p_.nodes);
    TeamCount count;
    std::int64_t numbers = 0;
    for (std::int32_t id = mine.begin; id < mine.end; ++id) {
      IslandNode& f = m_.node[id];
      count.part[0] += f.others;
      count.part[1] += f.owns();
      count.part[2] += forth_shape(f).tiles;
      count.part[3] += back_shape(f).tiles;
      f.numbers = 0;
      numbers += f.tiles() + forth_shape(f).numbers() + back_shape(f).numbers();
    }
    count.part[4] = static_cast<std::int32_t>(numbers);  // below 2^31: else the capacity is exceeded
    const TeamSums sums = sum_over<5>(team_, memory_.count, count);
    if (team_.rank() == 0) {
      p_.slots = sums.all.part[0];
      p_.first_slot = Atomics::add(&m_.counters->slots, p_.slots);
      p_.numbers = sums.all.part[4];
      p_.first_number =
          static_cast<std::int64_t>(Atomics::add(&m_.counters->numbers, static_cast<std::uint64_t>(p_.numbers)));
      if (p_.first_slot > m_.slots_capacity - p_.slots || p_.numbers < 0 ||
          p_.first_number + p_.numbers > static_cast<std::int64_t>(m_.numbers_capacity))
        p_.overflow = 1;
      IslandLevel& end = m_.level[p_.level + p_.levels];
      end.own = p_.first_own + p_.owns;
      end.forth_tile = p_.first_slot + sums.all.part[2];
      end.back_tile = p_.first_own + sums.all.part[3];
    }
    team_.sync();
    if (p_.overflow != 0) return;
    IslandNode at;
    at.first_other = p_.first_slot + sums.below.part[0];
    at.first_own = p_.first_own + sums.below.part[1];
    at.forth_tile = p_.first_slot + sums.below.part[2];
    at.back_tile = p_.first_own + sums.below.part[3];
    at.numbers = p_.first_number + sums.below.part[4];
    for (std::int32_t id = mine.begin; id < mine.end; ++id) place_node(m_.node[id], id, at);
    team_.sync();
    each_of(team_, 0, p_.levels, [&](std::int32_t level) {
      IslandLevel& l = m_.level[p_.level + level];
      const IslandNode& f = m_.node[l.node];
      l = {l.node, f.first_own, f.forth_tile, f.back_tile};
    });
  }

  /// Places a node at `at`, and moves on behind it.
  GEM_DEVICE void place_node(IslandNode& f, std::int32_t id, IslandNode& at) {
    f.first_other = at.first_other;
    f.first_own = at.first_own;
    f.forth_tile = at.forth_tile;
    f.back_tile = at.back_tile;
    f.numbers = at.numbers;
    for (std::int32_t k = 0; k < f.others; ++k) {
      m_.other[f.first_other + k] = m_.draft[f.draft + k];
      m_.front[f.first_other + k] = id;
      if (f.owns() == 0)  // gives nothing, and has no tiles
        m_.product[2 * (f.first_other + k)] = m_.product[2 * (f.first_other + k) + 1] = {};
    }
    for (std::int32_t p = f.own; p < f.end; ++p) m_.own_place[f.first_own + p - f.own] = p;
    const TileShape forth = forth_shape(f), back = back_shape(f);
    const std::int64_t forth_numbers = f.tiles(), back_numbers = forth_numbers + forth.numbers();
    for (std::int32_t k = 0; k < forth.tiles; ++k)
      m_.forth_tile[f.forth_tile + k] = {forth_numbers + k * forth.numbers_of_tile(),
                                         f.first_other + k * forth.bodies,
                                         forth.bodies_of(k, f.others),
                                         forth.lanes,
                                         f.own,
                                         f.owns(),
                                         0,
                                         0,
                                         forth.shift};
    for (std::int32_t k = 0; k < back.tiles; ++k)
      m_.back_tile[f.back_tile + k] = {back_numbers + k * back.numbers_of_tile(),
                                       f.own + k * back.bodies,
                                       back.bodies_of(k, f.owns()),
                                       back.lanes,
                                       f.own,
                                       f.owns(),
                                       f.first_other,
                                       f.others,
                                       back.shift};
    at.first_other += f.others;
    at.first_own += f.owns();
    at.forth_tile += forth.tiles;
    at.back_tile += back.tiles;
    at.numbers = back_numbers + back.numbers();
  }

  /// Whether the host's solver eliminates front `a` before `b`, two fronts below one body.
  GEM_DEVICE bool comes_before(std::int32_t a, std::int32_t b) const {
    const IslandNode &f = m_.node[a], &g = m_.node[b];
    if (f.own != g.own) return f.own < g.own;
    const bool own_f = f.end > f.own, own_g = g.end > g.own;
    return own_f != own_g ? own_g : f.depth > g.depth;
  }

  const Team& team_;
  TreePart& p_;
  const IslandView& v_;
  const IslandMemory& m_;
  IslandCell& cell_;
  const TeamMemory& memory_;
};

}  // namespace gem
