// Nested dissection of an island on a device: Dissection (dissection.h) level by level, the parts of a level side by
// side. The first levels of a large island become its trunk; then each block dissects a branch.
#pragma once

#include "gem/base/strict_math.h"
#include "gem/engine/solver/splitting/device/device_team.h"
#include "gem/engine/solver/splitting/factor/dissection_rules.h"

namespace gem {

/// Bits in the order of the numbers.
GEM_DEVICE inline std::uint64_t ordered_bits_of(double x) {
  const std::uint64_t bits = strict::bits_of(x), sign = std::uint64_t{1} << 63;
  return bits & sign ? ~bits : bits | sign;
}
GEM_DEVICE inline double from_ordered(std::uint64_t bits) {
  const std::uint64_t sign = std::uint64_t{1} << 63;
  return strict::double_of(bits & sign ? bits & ~sign : ~bits);
}

/// Cuts one part.
template <class Team>
class PartCutter {
 public:
  GEM_DEVICE PartCutter(const Team& team, const IslandGraph& graph, CutCell& cell, std::int32_t* count,
                        std::int32_t* nodes)
      : team_(team), g_(graph), cell_(cell), count_(count), nodes_(nodes) {}

  /// Cuts a node if it is not a leaf: sorts its bodies, and appends its two halves to the nodes.
  GEM_DEVICE void cut(std::int32_t id) {
    id_ = id;
    begin_ = g_.node[id].begin;
    end_ = g_.node[id].end;
    home_ = g_.home[g_.order[begin_]];
    if (end_ - begin_ <= largest_leaf) return close(begin_);
    set_extremes();
    count_bins();
    for (int axis = team_.rank(); axis < 2; axis += team_.size()) consider(axis);
    team_.sync();
    const IslandCut best = best_cut();
    if (best.axis < 0)
      close(begin_);
    else
      divide(best);
    team_.sync();
  }

 private:
  using Atomics = typename Team::Atomics;

  GEM_DEVICE void close(std::int32_t own) {
    if (team_.rank() == 0) g_.node[id_].own = own;
  }

  GEM_DEVICE void set_extremes() {
    for (int k = team_.rank(); k < 4; k += team_.size()) cell_.extreme[k] = 0;
    auto* const counts = &cell_.count[0][0];
    for (int k = team_.rank(); k < 6 * (cut_bins + 2); k += team_.size()) counts[k] = 0;
    team_.sync();
    for (std::int32_t k = begin_ + team_.rank(); k < end_; k += team_.size()) {
      const Vec2 at = g_.position[g_.order[k]];
      Atomics::highest(&cell_.extreme[0], ordered_bits_of(-at.x));
      Atomics::highest(&cell_.extreme[1], ordered_bits_of(-at.y));
      Atomics::highest(&cell_.extreme[2], ordered_bits_of(at.x));
      Atomics::highest(&cell_.extreme[3], ordered_bits_of(at.y));
    }
    team_.sync();
    strips_[0] = {-from_ordered(cell_.extreme[0]), from_ordered(cell_.extreme[2])};
    strips_[1] = {-from_ordered(cell_.extreme[1]), from_ordered(cell_.extreme[3])};
  }

  /// Blocks change the labels of their own branches only.
  GEM_DEVICE bool is_part(std::int32_t body) const { return g_.home[body] == home_ && g_.label[body] == id_; }

  GEM_DEVICE std::int32_t bin_of(std::int32_t axis, std::int32_t body) const {
    const Vec2 at = g_.position[body];
    return axis == 0 ? strips_[0].bin_of(at.x) : strips_[1].bin_of(at.y);
  }

  GEM_DEVICE void count_bins() {
    for (std::int32_t k = begin_ + team_.rank(); k < end_; k += team_.size())
      for (int axis = 0; axis < 2; ++axis) {
        const std::int32_t body = g_.order[k], bin = bin_of(axis, body);
        std::int32_t farthest = bin, nearest = bin;
        g_.each_neighbour(body, [&](std::int32_t other) {
          if (!is_part(other)) return;
          const std::int32_t at = bin_of(axis, other);
          farthest = at > farthest ? at : farthest;
          nearest = at < nearest ? at : nearest;
        });
        Atomics::add(&cell_.count[axis][bin], 1);
        Atomics::add(&cell_.change_below[axis][bin + 1], 1);
        Atomics::add(&cell_.change_below[axis][farthest + 1], -1);
        Atomics::add(&cell_.change_above[axis][nearest + 1], 1);
        Atomics::add(&cell_.change_above[axis][bin + 1], -1);
      }
    team_.sync();
  }

  GEM_DEVICE void consider(int axis) {
    IslandCut balanced, any;
    each_cut(cell_.count[axis], cell_.change_below[axis], cell_.change_above[axis], end_ - begin_,
             [&](std::int32_t bin, bool below, bool in_balance, double cost) {
               const IslandCut cut{axis, bin, below ? 1 : 0, cost};
               if (in_balance && (balanced.axis < 0 || cost < balanced.cost)) balanced = cut;
               if (any.axis < 0 || cost < any.cost) any = cut;
             });
    cell_.best[axis][0] = balanced;
    cell_.best[axis][1] = any;
  }

  GEM_DEVICE IslandCut best_cut() const {
    for (int k = 0; k < 2; ++k) {
      const IslandCut &x = cell_.best[0][k], &y = cell_.best[1][k];
      if (x.axis < 0 && y.axis < 0) continue;
      return y.axis >= 0 && (x.axis < 0 || y.cost < x.cost) ? y : x;
    }
    return {};
  }

  GEM_DEVICE std::int32_t side_of(const IslandCut& cut, std::int32_t body) const {
    const bool is_below = bin_of(cut.axis, body) < cut.bin;
    std::int32_t side = is_below ? 0 : 1;
    if (is_below != (cut.separator_below != 0)) return side;
    g_.each_neighbour(body, [&](std::int32_t other) {
      if (is_part(other) && (bin_of(cut.axis, other) < cut.bin) != is_below) side = 2;
    });
    return side;
  }

  GEM_DEVICE void divide(const IslandCut& cut) {
    if (team_.rank() == 0) cell_.child = Atomics::add(nodes_, 2);
    const TeamShare mine = share_of(team_, begin_, end_);
    TeamCount count;
    for (std::int32_t k = mine.begin; k < mine.end; ++k) {
      g_.side[k] = side_of(cut, g_.order[k]);
      ++count.part[g_.side[k]];
    }
    const TeamSums sums = sum_over<3>(team_, count_, count);
    const std::int32_t child = cell_.child;
    const std::int32_t middle = begin_ + sums.all.part[0], own = middle + sums.all.part[1];
    std::int32_t to[3] = {begin_ + sums.below.part[0], middle + sums.below.part[1], own + sums.below.part[2]};
    for (std::int32_t k = mine.begin; k < mine.end; ++k) {
      const std::int32_t body = g_.order[k], side = g_.side[k];
      g_.next_order[to[side]++] = body;
      g_.next_label[body] = side == 2 ? id_ : child + side;
    }
    team_.sync();
    for (std::int32_t k = begin_ + team_.rank(); k < end_; k += team_.size()) g_.order[k] = g_.next_order[k];
    if (team_.rank() != 0) return;
    IslandNode& node = g_.node[id_];
    node.own = own;
    node.child[0] = child;
    node.child[1] = child + 1;
    for (int half = 0; half < 2; ++half) {
      IslandNode part;
      part.begin = half == 0 ? begin_ : middle;
      part.end = half == 0 ? middle : own;
      part.parent = id_;
      part.depth = node.depth + 1;
      g_.node[child + half] = part;
    }
  }

  const Team& team_;
  const IslandGraph& g_;
  CutCell& cell_;
  std::int32_t *count_, *nodes_;
  std::int32_t id_ = 0, begin_ = 0, end_ = 0, home_ = -1;
  CutStrips strips_[2];
};

/// Dissects a part of an island, `levels` levels at most, by the threads of a block or a warp. `top`: its first node,
/// already set; further nodes follow. The levels stand from `level` on; they have nodes only.
template <class Team>
class PartDissector {
 public:
  GEM_DEVICE PartDissector(const Team& team, const IslandView& view, const TeamMemory& memory)
      : team_(team), v_(view), memory_(memory) {}

  /// Returns how many levels there are. memory.part->nodes: the end of the nodes.
  GEM_DEVICE std::int32_t dissect(std::int32_t top, std::int32_t level_at, std::int32_t levels) {
    const IslandNode whole = v_.m.node[top];
    each_of(team_, whole.begin, whole.end, [&](std::int32_t k) {
      const std::int32_t body = v_.graph.order[k];
      v_.graph.label[body] = v_.graph.next_label[body] = top;
    });
    if (team_.rank() == 0) {
      memory_.part->nodes = top + 1;
      v_.m.level[level_at].node = top;
    }
    team_.sync();
    std::int32_t first = top;
    for (std::int32_t level = 0;; ++level) {
      const std::int32_t last = memory_.part->nodes;
      team_.sync();
      if (team_.rank() == 0) v_.m.level[level_at + level + 1].node = last;
      if (level == levels) return level + 1;
      cut_level(first, last);
      team_.sync();
      each_of(team_, whole.begin, whole.end, [&](std::int32_t k) {
        const std::int32_t body = v_.graph.order[k];
        v_.graph.label[body] = v_.graph.next_label[body];
      });
      first = last;
      const bool done = memory_.part->nodes == last;
      team_.sync();
      if (done) return level + 1;
    }
  }

 private:
  using Warp = typename Team::Warp;

  /// A few parts are cut by all threads, one after another, many by a warp each.
  GEM_DEVICE void cut_level(std::int32_t first, std::int32_t last) {
    const int warps = team_.warps(), index = team_.warp_index();
    if (4 * (last - first) > warps) {
      const OneWarp warp{team_.warp()};
      PartCutter<OneWarp> cutter(warp, v_.graph, memory_.cut[index],
                                 memory_.count + TeamMemory::counts * index * Warp::size, &memory_.part->nodes);
      for (std::int32_t id = first + index; id < last; id += warps) cutter.cut(id);
    } else {
      PartCutter<Team> cutter(team_, v_.graph, memory_.cut[0], memory_.count, &memory_.part->nodes);
      for (std::int32_t id = first; id < last; ++id) cutter.cut(id);
    }
  }

  /// A warp as a team.
  struct OneWarp {
    using Atomics = typename Team::Atomics;
    Warp warp;
    GEM_DEVICE int rank() const { return warp.rank(); }
    GEM_DEVICE int size() const { return Warp::size; }
    GEM_DEVICE void sync() const { warp.sync(); }
  };

  const Team& team_;
  const IslandView& v_;
  const TeamMemory& memory_;
};

/// Dissects an island into a trunk and branches. All parts of a team have to call it.
template <class Team>
class TreeBuilder {
 public:
  GEM_DEVICE TreeBuilder(const Team& team, const IslandView& view, IslandCell& cell, const TeamMemory& memory)
      : team_(team), part_(team.part()), v_(view), cell_(cell), memory_(memory) {}

  GEM_DEVICE void build() {
    each_of(team_, 0, v_.bodies, [&](std::int32_t k) {
      v_.graph.order[k] = k;
      v_.graph.home[k] = -1;
    });
    team_.sync();
    if (team_.part_index() == 0) cut_trunk();
    team_.sync();
    TreePart& branch = memory_.part->branch;
    if (part_.rank() == 0) {
      memory_.part->trunk = cell_.trunk;
      branch = {};
      if (team_.part_index() < cell_.branches) begin_branch(branch);
    }
    part_.sync();
    if (branch.owns == 0) return;
    const std::int32_t levels = PartDissector<Part>(part_, v_, memory_)
                                    .dissect(branch.first_node, branch.level, v_.bodies);  // ends before that
    if (part_.rank() == 0) {
      branch.levels = levels;
      branch.nodes = memory_.part->nodes - branch.first_node;
    }
    part_.sync();
  }

 private:
  using Part = typename Team::Part;

  GEM_DEVICE void cut_trunk() {
    std::int32_t cuts = 0;
    while ((2 << cuts) <= team_.parts()) ++cuts;  // a branch for each block, or fewer
    const std::int32_t above = 2 * (v_.m.bodies_capacity - cell_.base) + cell_.taken * trunk_nodes;
    const std::int32_t level = 2 * (v_.m.bodies_capacity - cell_.base) + cell_.taken * trunk_levels;
    const std::int32_t top = cuts == 0 ? 0 : above;
    if (part_.rank() == 0) {
      IslandNode all;
      all.end = v_.bodies;
      v_.m.node[top] = all;
      cell_.trunk = {};
      cell_.branches = 0;
    }
    part_.sync();
    if (cuts == 0) {
      if (part_.rank() == 0) {
        cell_.branch[0] = 0;
        cell_.branches = 1;
      }
    } else {
      const std::int32_t levels = PartDissector<Part>(part_, v_, memory_).dissect(top, level, cuts);
      if (part_.rank() == 0) end_trunk(top, level, levels, cuts);
    }
    part_.sync();
    for (std::int32_t k = 0; k < cell_.branches; ++k) {
      const IslandNode& branch = v_.m.node[cell_.branch[k]];
      each_of(part_, branch.begin, branch.end, [&](std::int32_t at) { v_.graph.home[v_.graph.order[at]] = k; });
    }
  }

  /// Moves the nodes of the last level, the branches, to where their own nodes will follow.
  GEM_DEVICE void end_trunk(std::int32_t top, std::int32_t level, std::int32_t levels, std::int32_t cuts) {
    TreePart& trunk = cell_.trunk;
    trunk.first_node = top;
    trunk.level = level;
    trunk.levels = levels > cuts ? cuts : levels;
    trunk.nodes = v_.m.level[level + trunk.levels].node - top;
    std::int32_t bodies = 0;
    const std::int32_t end = memory_.part->nodes;
    for (std::int32_t id = top + trunk.nodes; id < end; ++id) {
      const IslandNode node = v_.m.node[id];
      const std::int32_t moved = 2 * bodies;
      v_.m.node[moved] = node;
      IslandNode& parent = v_.m.node[node.parent];
      parent.child[parent.child[1] == id ? 1 : 0] = moved;
      cell_.branch[cell_.branches++] = moved;
      bodies += node.end - node.begin;
    }
    trunk.first_own = bodies;
    trunk.owns = v_.bodies - bodies;
  }

  GEM_DEVICE void begin_branch(TreePart& branch) const {
    const std::int32_t top = cell_.branch[team_.part_index()];
    const IslandNode& node = v_.m.node[top];
    branch.begin = node.begin;
    branch.end = node.end;
    branch.first_own = top / 2;
    branch.owns = node.end - node.begin;
    branch.first_node = branch.level = top;
  }

  const Team& team_;
  const Part part_;
  const IslandView& v_;
  IslandCell& cell_;
  const TeamMemory& memory_;
};

}  // namespace gem
