// Operator splitting for all islands of a time step on a device. Groups of blocks take one large island after another:
// one block finds the fronts, and all iterate. Then blocks take the others, and at last warps take the small ones.
#pragma once

#include "gem/engine/solver/splitting/device_island_solver.h"
#include "gem/engine/solver/splitting/device_islands.h"

namespace gem {

/// Shared memory of a block that solves islands [bytes].
GEM_HD constexpr std::size_t islands_shared_bytes(int threads, int warp) {
  return TeamMemory::bytes(threads / warp, warp);
}

template <class Group>
class IslandsOnDevice {
 public:
  /// `cell`: of the group of blocks.
  GEM_DEVICE IslandsOnDevice(const DeviceScene& s, Group& group, IslandCell& cell)
      : s_(s), m_(s.island), group_(group), cell_(cell) {}

  GEM_DEVICE void solve() {
    const std::int32_t large = m_.counters->large, not_small = m_.counters->not_small, all = m_.counters->islands;
    const GroupTeam<Group> group(group_);
    const BlockTeam<Group> block(group_);
    const WarpTeam<Group> warp(group_);
    const int warp_index = group_.thread() / Group::Warp::size, warps = group_.threads() / Group::Warp::size;
    TeamMemory of_block = memory_of(0);
    of_block.cell = &cell_;
    each_island(group, cell_, m_.counters->next_large, 0, large, [&](std::int32_t root) {
      if (group_.block() == 0) find_fronts(block, warp, warp_index, warps, of_block, root);
      group.sync();
      if (cell_.iterates != 0) iterate(group, cell_);
    });
    of_block = memory_of(0);
    each_island(block, *of_block.cell, m_.counters->next_block, large, not_small, [&](std::int32_t root) {
      if (find_fronts(block, warp, warp_index, warps, of_block, root)) iterate(block, *of_block.cell);
    });
    const TeamMemory of_warp = memory_of(warp_index);
    each_island(warp, *of_warp.cell, m_.counters->next_small, not_small, all, [&](std::int32_t root) {
      if (find_fronts(warp, warp, 0, 1, of_warp, root)) iterate(warp, *of_warp.cell);
    });
  }

 private:
  /// Calls work(root) for islands [begin, end), as long as there are any that no other team took.
  template <class Team, class Work>
  GEM_DEVICE void each_island(const Team& team, IslandCell& cell, std::int32_t& next, std::int32_t begin,
                              std::int32_t end, Work&& work) {
    for (;;) {
      if (team.rank() == 0) cell.taken = Group::add(&next, 1);
      team.sync();
      const std::int32_t taken = begin + cell.taken;
      team.sync();
      if (taken >= end) return;
      work(m_.island[taken]);
      team.sync();
    }
  }

  template <class Team>
  GEM_DEVICE void iterate(const Team& team, IslandCell& cell) {
    DeviceIslandSolver<Team>(s_, team, cell.view, cell).solve();
  }

  /// Shared memory from a warp on.
  GEM_DEVICE TeamMemory memory_of(int warp) const {
    const int warps = group_.threads() / Group::Warp::size;
    std::byte* const from = group_.shared_memory();
    std::byte* const cuts = from + warps * TeamMemory::cell_bytes();
    std::byte* const counts = cuts + warps * TeamMemory::cut_bytes();
    return {reinterpret_cast<IslandCell*>(from + warp * TeamMemory::cell_bytes()),
            reinterpret_cast<CutCell*>(cuts + warp * TeamMemory::cut_bytes()),
            reinterpret_cast<std::int32_t*>(counts) + 3 * warp * Group::Warp::size};
  }

  /// Prepares an island for its iterations. Returns false if it needs none, or if its fronts do not fit in memory.
  /// `sub`: warp number `sub_rank` of `subs` of the team.
  template <class Team, class Sub>
  GEM_DEVICE bool find_fronts(const Team& team, const Sub& sub, int sub_rank, int subs, const TeamMemory& memory,
                              std::int32_t root) {
    IslandView& view = memory.cell->view;
    gather_bodies(team, memory, view, root);
    gather_points(team, memory, view);
    if (DeviceIslandSolver<Team>(s_, team, view, *memory.cell).settled()) return false;
    const std::int32_t levels = dissect(team, sub, sub_rank, subs, view.graph, memory);
    if (team.rank() == 0) {
      view.levels = levels;
      view.nodes = memory.cell->nodes;
    }
    team.sync();
    FrontFinder<Team> fronts(team, view, m_, memory);
    const bool fit = fronts.find();
    if (!fit) {
      group_.raise(alarm_solver_full);
      return false;
    }
    if (team.rank() == 0) memory.cell->iterates = 1;
    set_places(team, view);
    return true;
  }

  /// Lists the bodies of an island by rank, and gives the island its part of the memory.
  template <class Team>
  GEM_DEVICE void gather_bodies(const Team& team, const TeamMemory& memory, IslandView& view, std::int32_t root) {
    const TeamShare mine = share_of(team, root, m_.counters->bodies);
    TeamCount count;
    for (std::int32_t rank = mine.begin; rank < mine.end; ++rank) count.part[0] += m_.root[rank] == root ? 1 : 0;
    const TeamSums sums = sum_over(team, memory.count, count);
    IslandCell& cell = *memory.cell;
    if (team.rank() == 0) {
      cell.bodies = sums.all.part[0];
      cell.base = Group::add(&m_.counters->body_slots, cell.bodies);
      cell.points = cell.overflow = cell.iterates = 0;
      view = {};
      view.bodies = cell.bodies;
      begin_arrays(view, cell.base);
    }
    team.sync();
    std::int32_t at = sums.below.part[0];
    for (std::int32_t rank = mine.begin; rank < mine.end; ++rank) {
      if (m_.root[rank] != root) continue;
      const std::int32_t entry = m_.entry[rank];
      m_.index[rank] = at;
      view.m.member[at] = entry;
      view.m.position[at] = s_.body[s_.solver_entry[entry].body].position;
      ++at;
    }
    team.sync();
  }

  GEM_DEVICE void begin_arrays(IslandView& view, std::int32_t base) const {
    IslandMemory& m = view.m = m_;
    for (std::int32_t** array : {&m.member, &m.place, &m.label, &m.next_label, &m.order, &m.next_order, &m.side,
                                 &m.own_place, &m.parts_in, &m.first_in, &m.filled_in})
      *array += base;
    m.position += base;
    m.scaled += base;
    m.pivot += base;
    m.share += base;
    for (FloatQuad** array : {&m.now, &m.sum, &m.solution, &m.given, &m.last_given}) *array += 2 * base;
    m.node += 2 * base;
    m.level += 2 * base;
    view.graph = {view.bodies,  m.position, s_.solver_entry, m.member, m.neighbour, m.label,
                  m.next_label, m.order,    m.next_order,    m.side,   m.node,      m.level};
  }

  /// Calls work(record, taken point, whether the body is its B) for the points of a body.
  template <class Work>
  GEM_DEVICE GEM_INLINE void each_record(const IslandView& view, std::int32_t body, Work&& work) const {
    const SolverEntry& entry = s_.solver_entry[view.m.member[body]];
    for (std::int32_t k = 0; k < entry.count; ++k)
      work(entry.place + k, m_.taken_of_record[entry.place + k], k < entry.as_b);
  }

  /// Lists the points of an island, each with its B, or with its A if B is fixed; and the neighbours of the bodies.
  template <class Team>
  GEM_DEVICE void gather_points(const Team& team, const TeamMemory& memory, IslandView& view) {
    IslandCell& cell = *memory.cell;
    each_of(team, 0, view.bodies, [&](std::int32_t body) {
      each_record(view, body, [&](std::int32_t record, std::int32_t taken, bool as_b) {
        const PointCell& point = s_.taken_point[taken];
        const PointSide& other = as_b ? point.a : point.b;
        m_.neighbour[record] = other.place >= 0 ? m_.index[m_.rank[other.body]] : -1;
        if (as_b || other.place < 0) Group::add(&cell.points, 1);
      });
    });
    team.sync();
    if (team.rank() == 0) {
      view.points = cell.points;
      cell.first_point = Group::add(&m_.counters->point_slots, view.points);
      cell.points = 0;
      view.m.where += cell.first_point;
      view.m.point += cell.first_point;
    }
    team.sync();
    each_of(team, 0, view.bodies, [&](std::int32_t body) {
      each_record(view, body, [&](std::int32_t, std::int32_t taken, bool as_b) {
        const PointCell& point = s_.taken_point[taken];
        if (!as_b && point.b.place >= 0) return;
        const std::int32_t k = Group::add(&cell.points, 1);
        if (point.a.place >= 0) m_.point_of[point.a.place] = k;
        if (point.b.place >= 0) m_.point_of[point.b.place] = k;
        IslandPointPlace& at = view.m.where[k];
        at = {};
        at.taken = taken;
        at.record_a = point.a.place;
        at.record_b = point.b.place;
      });
    });
    team.sync();
  }

  /// Sets where the points find their bodies, and the constants of points and bodies.
  template <class Team>
  GEM_DEVICE void set_places(const Team& team, IslandView& view) {
    each_of(team, 0, view.points, [&](std::int32_t k) {
      IslandPointPlace& at = view.m.where[k];
      const PointCell& point = s_.taken_point[at.taken];
      const auto place_of = [&](const PointSide& side) {
        return side.place < 0 ? -1 : view.m.place[m_.index[m_.rank[side.body]]];
      };
      at.a = place_of(point.a);
      at.b = place_of(point.b);
      if (point.slot == 0) at.row_length = 0;
      if (point.slot == 0 && at.b >= 0 && s_.contact[point.pair].count > 1) at.second = m_.point_of[point.b.place + 1];
      set_point(view.m.point[k], 0, s_.points.geometry(at.taken), inverse_mass_of(s_, point.a),
                inverse_mass_of(s_, point.b));
    });
    each_of(team, 0, view.bodies, [&](std::int32_t place) {
      const BodyCell& body = s_.body[s_.solver_entry[view.m.member[view.m.order[place]]].body];
      view.m.scaled[place] = scaled_body({body.inverse_mass, body.inverse_inertia});
    });
    team.sync();
  }

  const DeviceScene& s_;
  const IslandMemory& m_;
  Group& group_;
  IslandCell& cell_;
};

}  // namespace gem
