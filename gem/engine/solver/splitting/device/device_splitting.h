// Operator splitting for all islands of a time step on a device. Groups of blocks take one large island after another,
// then blocks take the others, and at last warps take the small ones.
#pragma once

#include "gem/engine/solver/splitting/device/device_island_gradient.h"
#include "gem/engine/solver/splitting/device/device_island_solver.h"
#include "gem/engine/solver/splitting/device/device_islands.h"

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
    TeamMemory of_group = memory_of(0, true);
    of_group.cell = &cell_;
    each_island(group, of_group, m_.counters->next_large, 0, large);
    each_island(block, memory_of(0, true), m_.counters->next_block, large, not_small);
    each_island(warp, memory_of(group_.thread() / Group::Warp::size, false), m_.counters->next_small, not_small, all);
  }

 private:
  /// Solves islands [begin, end), as long as there are any that no other team took.
  template <class Team>
  GEM_DEVICE void each_island(const Team& team, const TeamMemory& memory, std::int32_t& next, std::int32_t begin,
                              std::int32_t end) {
    for (;;) {
      if (team.rank() == 0) memory.cell->taken = begin + Group::add(&next, 1);
      team.sync();
      const std::int32_t taken = memory.cell->taken;
      team.sync();
      if (taken >= end) return;
      if (find_fronts(team, memory, m_.island[taken])) DeviceIslandSolver<Team>(s_, team, memory).solve();
      team.sync();
    }
  }

  /// Shared memory from a warp on; `all`: that of the block.
  GEM_DEVICE TeamMemory memory_of(int warp, bool all) const {
    return TeamMemory::of(group_.shared_memory(), warp, group_.threads() / Group::Warp::size, Group::Warp::size, all);
  }

  /// Prepares an island for its iterations. Returns false if it needs none, or if its fronts do not fit in memory.
  template <class Team>
  GEM_DEVICE bool find_fronts(const Team& team, const TeamMemory& memory, std::int32_t root) {
    IslandView& view = memory.part->view;
    gather_bodies(team, memory, root);
    gather_points(team, memory, view);
    if (DeviceIslandSolver<Team>(s_, team, memory).settled()) return false;
    DeviceIslandGradient<Team> gradient(s_, team, memory);
    if (const GradientPlan plan = gradient.make_plan(); plan.first) {
      gradient.place_by_body();
      double error = 0.0;  // rounds of splitting set it anew
      if (gradient.solve(plan.joins_rounds, 0, error)) return false;
    }
    TreeBuilder<Team>(team, view, *memory.cell, memory).build();
    if (!set_fronts(team, memory)) {
      group_.raise(alarm_solver_full);
      return false;
    }
    set_places(team, view);
    return true;
  }

  /// Returns false if the fronts do not fit.
  template <class Team>
  GEM_DEVICE bool set_fronts(const Team& team, const TeamMemory& memory) {
    using Part = typename Team::Part;
    PartCell& p = *memory.part;
    const IslandView& view = p.view;
    const Part part = team.part();
    team.sync();  // all orders are set
    each_of(team, 0, view.bodies, [&](std::int32_t k) {
      view.m.place[view.m.order[k]] = k;
      view.m.parts_in[k] = view.m.filled_in[k] = 0;
    });
    team.sync();
    FrontFinder<Part> of_branch(part, p.branch, view, *memory.cell, memory);
    FrontFinder<Part> of_trunk(part, p.trunk, view, *memory.cell, memory);
    const bool has_branch = p.branch.levels > 0, has_trunk = p.trunk.levels > 0;
    const bool finds_trunk = has_trunk && team.part_index() == 0;
    if (has_branch) of_branch.find();
    team.sync();
    if (has_trunk) {
      if (finds_trunk) of_trunk.find();
      if (finds_trunk && part.rank() == 0) memory.cell->trunk = p.trunk;
      team.sync();
      if (part.rank() == 0) p.trunk = memory.cell->trunk;
      part.sync();
    }
    if (memory.cell->overflow != 0) return false;
    if (has_branch) of_branch.count_parts();
    if (finds_trunk) of_trunk.count_parts();
    team.sync();
    if (has_branch) of_branch.place_parts();
    if (finds_trunk) of_trunk.place_parts();
    team.sync();
    if (has_branch) of_branch.fill_parts();
    if (finds_trunk) of_trunk.fill_parts();
    team.sync();
    if (has_branch) of_branch.sort_parts();
    if (finds_trunk) of_trunk.sort_parts();
    team.sync();
    return true;
  }

  /// Lists the bodies of an island by rank, and gives the island its part of the memory. Sets the views of all parts.
  template <class Team>
  GEM_DEVICE void gather_bodies(const Team& team, const TeamMemory& memory, std::int32_t root) {
    const auto part = team.part();
    IslandCell& cell = *memory.cell;
    if (team.part_index() == 0) {
      const TeamShare mine = share_of(part, root, m_.counters->bodies);
      TeamCount count;
      for (std::int32_t rank = mine.begin; rank < mine.end; ++rank) count.part[0] += m_.root[rank] == root ? 1 : 0;
      const TeamSums sums = sum_over<1>(part, memory.count, count);
      if (part.rank() == 0) {
        cell.bodies = sums.all.part[0];
        cell.base = Group::add(&m_.counters->body_slots, cell.bodies);
        cell.points = cell.contacts = cell.overflow = 0;
      }
      part.sync();
      std::int32_t at = sums.below.part[0];
      for (std::int32_t rank = mine.begin; rank < mine.end; ++rank) {
        if (m_.root[rank] != root) continue;
        const std::int32_t entry = m_.entry[rank];
        m_.index[rank] = at;
        m_.member[cell.base + at] = entry;
        const std::int32_t body = s_.solver_entry[entry].body;
        // body 0 is the platform: its cell has the position before the first half of the time step
        m_.position[cell.base + at] = body == 0 ? s_.platform->mid_position : s_.body[body].position;
        ++at;
      }
    }
    team.sync();
    if (part.rank() == 0) begin_view(memory.part->view, cell);
    part.sync();
  }

  GEM_DEVICE void begin_view(IslandView& view, const IslandCell& cell) const {
    view.bodies = cell.bodies;
    IslandMemory& m = view.m = m_;
    const std::int32_t base = cell.base;
    for (std::int32_t** array : {&m.member, &m.place, &m.label, &m.next_label, &m.home, &m.order, &m.next_order,
                                 &m.side, &m.own_place, &m.parts_in, &m.first_in, &m.filled_in})
      *array += base;
    m.position += base;
    m.scaled += base;
    m.records += base;
    m.back_tile += base;
    m.pivot += 3 * base;
    m.share += 3 * base;
    for (FloatQuad** array : {&m.now, &m.sum, &m.solution, &m.given}) *array += 2 * base;
    m.node += 2 * base;
    m.level += 2 * base;
    view.graph = {view.bodies,  m.position, s_.solver_entry, m.member,     m.neighbour, m.label,
                  m.next_label, m.home,     m.order,         m.next_order, m.side,      m.node};
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
      std::int32_t count = 0, contacts = 0;
      each_record(view, body, [&](std::int32_t record, std::int32_t taken, bool as_b) {
        const PointCell& point = s_.taken_point[taken];
        const PointSide& other = as_b ? point.a : point.b;
        m_.neighbour[record] = other.place >= 0 ? m_.index[m_.rank[other.body]] : -1;
        if (!as_b && other.place >= 0) return;
        ++count;
        contacts += point.slot == 0 ? 1 : 0;
      });
      if (count > 0) Group::add(&cell.points, count);
      if (contacts > 0) Group::add(&cell.contacts, contacts);
    });
    team.sync();
    const std::int32_t points = cell.points;
    team.sync();
    if (team.rank() == 0) {
      cell.first_point = Group::add(&m_.counters->point_slots, points);
      cell.points = 0;
    }
    team.sync();
    if (team.part().rank() == 0) {
      view.points = points;
      view.contacts = cell.contacts;
      view.m.where += cell.first_point;
      view.m.ends += cell.first_point;
      view.m.point += cell.first_point;
      view.m.gradient_point += cell.first_point;
    }
    team.part().sync();
    each_of(team, 0, view.bodies, [&](std::int32_t body) {
      each_record(view, body, [&](std::int32_t, std::int32_t taken, bool as_b) {
        const PointCell& point = s_.taken_point[taken];
        if (!as_b && point.b.place >= 0) return;
        const std::int32_t k = Group::add(&cell.points, 1);
        if (point.a.place >= 0) m_.point_of[point.a.place] = k;
        if (point.b.place >= 0) m_.point_of[point.b.place] = k;
        view.m.where[k] = {};
        view.m.where[k].taken = taken;
        view.m.ends[k].record_a = point.a.place;
        view.m.ends[k].record_b = point.b.place;
      });
    });
    team.sync();
  }

  /// Sets where the points find their bodies, and the constants of points and bodies.
  template <class Team>
  GEM_DEVICE void set_places(const Team& team, IslandView& view) {
    each_of(team, 0, view.points, [&](std::int32_t k) {
      IslandPointPlace& at = view.m.where[k];
      IslandPointEnds& ends = view.m.ends[k];
      const PointCell& point = s_.taken_point[at.taken];
      const auto place_of = [&](const PointSide& side) {
        return side.place < 0 ? -1 : view.m.place[m_.index[m_.rank[side.body]]];
      };
      ends.a = place_of(point.a);
      ends.b = place_of(point.b);
      if (ends.a >= 0 && ends.b >= 0) link_pair(point, at);
      SplitPoint<float> q{};
      set_point(q, 0, s_.points.geometry(at.taken), inverse_mass_of(s_, point.a), inverse_mass_of(s_, point.b));
      store_point<point_fields::all>(view, k, q);
    });
    each_of(team, 0, view.bodies, [&](std::int32_t place) {
      const SolverEntry& entry = s_.solver_entry[view.m.member[view.m.order[place]]];
      const BodyCell& body = s_.body[entry.body];
      view.m.scaled[place] = scaled_body({body.inverse_mass, body.inverse_inertia});
      view.m.records[place] = {entry.place, entry.count, entry.as_b, 0};
    });
    team.sync();
  }

  /// Links the points between two moving bodies, since they have one block of the matrix: those of a contact, and those
  /// of all pieces of a platform with a floe. They are neighbours among the records of B.
  GEM_DEVICE void link_pair(const PointCell& point, IslandPointPlace& at) {
    const SolverEntry& of_b = s_.solver_entry[m_.entry[m_.rank[point.b.body]]];
    const auto has_same_bodies = [&](std::int32_t record) {
      return record >= of_b.place && record < of_b.place + of_b.as_b &&
             s_.taken_point[m_.taken_of_record[record]].a.body == point.a.body;
    };
    if (!has_same_bodies(point.b.place - 1)) at.row_length = 0;
    if (has_same_bodies(point.b.place + 1)) at.next = m_.point_of[point.b.place + 1];
  }

  const DeviceScene& s_;
  const IslandMemory& m_;
  Group& group_;
  IslandCell& cell_;
};

}  // namespace gem
