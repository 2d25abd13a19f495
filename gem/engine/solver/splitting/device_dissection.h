// Nested dissection of an island on a device: Dissection (dissection.h) level by level, the parts of a level side by
// side.
#pragma once

#include "gem/base/strict_math.h"
#include "gem/engine/solver/splitting/device_team.h"
#include "gem/engine/solver/splitting/dissection_rules.h"

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
          if (g_.label[other] != id_) return;
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
      if (g_.label[other] == id_ && (bin_of(cut.axis, other) < cut.bin) != is_below) side = 2;
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
    const TeamSums sums = sum_over(team_, count_, count);
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
    node.child = child;
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
  std::int32_t id_ = 0, begin_ = 0, end_ = 0;
  CutStrips strips_[2];
};

/// Dissects an island. Returns how many levels its tree has. `Sub`: a warp of the team; `sub` of `subs`. Nodes of level
/// k are those from graph.level[k] on.
template <class Team, class Sub>
GEM_DEVICE inline std::int32_t dissect(const Team& team, const Sub& sub, std::int32_t sub_rank, std::int32_t subs,
                                       const IslandGraph& graph, const TeamMemory& memory) {
  for (std::int32_t k = team.rank(); k < graph.bodies; k += team.size()) {
    graph.order[k] = k;
    graph.label[k] = graph.next_label[k] = 0;
  }
  if (team.rank() == 0) {
    IslandNode all;
    all.end = graph.bodies;
    graph.node[0] = all;
    memory.cell->nodes = 1;
    graph.level[0] = 0;
  }
  team.sync();
  std::int32_t first = 0;
  for (std::int32_t level = 0;; ++level) {
    const std::int32_t last = memory.cell->nodes;
    team.sync();
    if (team.rank() == 0) graph.level[level + 1] = last;
    if (4 * (last - first) > subs) {
      PartCutter<Sub> cutter(sub, graph, memory.cut[sub_rank], memory.count + 3 * sub_rank * sub.size(),
                             &memory.cell->nodes);
      for (std::int32_t id = first + sub_rank; id < last; id += subs) cutter.cut(id);
    } else {
      PartCutter<Team> cutter(team, graph, memory.cut[0], memory.count, &memory.cell->nodes);
      for (std::int32_t id = first; id < last; ++id) cutter.cut(id);
    }
    team.sync();
    for (std::int32_t k = team.rank(); k < graph.bodies; k += team.size()) graph.label[k] = graph.next_label[k];
    first = last;
    const bool done = memory.cell->nodes == last;
    team.sync();
    if (done) return level + 1;
  }
}

}  // namespace gem
