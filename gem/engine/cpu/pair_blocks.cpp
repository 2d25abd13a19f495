#include "gem/engine/cpu/pair_blocks.h"

#include <algorithm>

namespace gem {
namespace {

void set(VecOf<DoublePack>& to, int lane, Vec2 v) {
  to.x[lane] = v.x;
  to.y[lane] = v.y;
}

VecOf<double> get(const VecOf<DoublePack>& v, int lane) { return {v.x[lane], v.y[lane]}; }

/// Motions of several bodies, side by side.
GEM_INLINE MotionOf<DoublePack> motions(const SubMotion* const* row) {
  static_assert(sizeof(SubMotion) == 2 * sizeof(DoublePack));
  DoublePack place[double_lanes], speed[double_lanes];
  for (int l = 0; l < double_lanes; ++l) {
    const auto* numbers = reinterpret_cast<const char*>(row[l]);
    __builtin_memcpy(&place[l], numbers, sizeof(DoublePack));
    __builtin_memcpy(&speed[l], numbers + sizeof(DoublePack), sizeof(DoublePack));
  }
  transpose(place);
  transpose(speed);
  return {{place[0], place[1]}, place[2], place[3], {speed[0], speed[1]}, speed[2]};
}

}  // namespace

void PairBlocks::clear() {
  block_.clear();
  corner_.clear();
  side_.clear();
  std::fill(filling_.begin(), filling_.end(), -1);
}

PairLane PairBlocks::add(std::int32_t id, int corners, double bound, double exponent) {
  if (static_cast<std::size_t>(corners) >= filling_.size()) filling_.resize(corners + 1, -1);
  std::int32_t& filling = filling_[corners];
  if (filling < 0 || block_[filling].filled == double_lanes) {
    filling = static_cast<std::int32_t>(block_.size());
    block_.emplace_back();
    block_.back().pair.first = static_cast<std::int32_t>(corner_.size());
    block_.back().pair.count = corners;
    corner_.resize(corner_.size() + corners);
  }
  Block& block = block_[filling];
  const std::int32_t lane = block.filled++;
  block.id[lane] = id;
  block.pair.bound[lane] = bound;
  block.pair.half_exponent[lane] = 0.5 * exponent;
  return {filling, lane};
}

void PairBlocks::set_corner(PairLane at, int corner, const CornerAtStart& from) {
  Corner& c = corner_[block_[at.block].pair.first + corner];
  const int l = at.lane;
  c.of_b[l] = from.of_b ? -1 : 0;
  set(c.corner, l, from.tip.at);
  set(c.between, l, from.between);
  for (int k = 0; k < 2; ++k) set(c.flank[k], l, from.tip.flank[k]);
  c.first_side[l] = from.first_side;
  c.full_stiffness[l] = from.full_stiffness;
  c.law.stiffness[l] = from.law.stiffness;
  c.law.damping[l] = from.law.damping;
  c.law.friction[l] = from.law.friction;
  const CornerMemory& m = from.memory;
  c.memory.crushed[l] = m.crushed;
  c.memory.stretch[l] = m.stretch;
  c.memory.stiffness[l] = m.stiffness;
  c.memory.elastic[l] = m.elastic;
  c.memory.normal[l] = m.normal;
  c.memory.side[l] = m.side;
  c.memory.pressed_side[l] = static_cast<double>(m.pressed_side);
  c.overlaps[l] = from.overlapped ? -1 : 0;

  const Outline& o = from.surface.outline;
  if (o.count > c.sides) {  // more sides than other lanes have: they move to the end
    const std::int32_t first = static_cast<std::int32_t>(side_.size());
    side_.resize(side_.size() + o.count);
    std::copy_n(side_.begin() + c.first, c.sides, side_.begin() + first);
    c.first = first;
    c.sides = o.count;
  }
  const bool any_met = can_meet_any(from.surface, from.tip);
  for (int j = 0; j < o.count; ++j) {
    SubSide<Pack>& side = side_[c.first + j];
    set(side.normal, l, o.normal[j]);
    side.offset[l] = dot(o.normal[j], o.corner[j]);
    side.role[l] = !from.surface.shows(j)                        ? side_role::bounds
                   : !any_met || can_meet(from.tip, o.normal[j]) ? side_role::meets
                                                                 : side_role::shows;
  }
}

void PairBlocks::look(PairLane at, MotionRow a, MotionRow b) {
  Block& block = block_[at.block];
  if (!block.active) {
    block.active = true;
    block.looked = MaskOf<Pack>{};
    for (auto& rows : block.row) std::fill(rows, rows + double_lanes, nullptr);
  }
  block.looked[at.lane] = -1;
  const MotionRow mover[2] = {a, b};
  for (int k = 0; k < 2; ++k) {
    if (mover[k].stays)
      block.row[k][at.lane] = mover[k].row;
    else
      block.own[k][at.lane] = *mover[k].row;
  }
}

GEM_INLINE void PairBlocks::press_block(Block& block, double h, std::vector<PairPush>& push,
                                        std::vector<std::uint8_t>& presses) {
  const SubMotion* row[2][double_lanes];
  for (int k = 0; k < 2; ++k)
    for (int l = 0; l < double_lanes; ++l) row[k][l] = block.row[k][l] ? block.row[k][l] : &block.own[k][l];
  const PairPushOf<Pack> given = press_pair(block.pair, &corner_[block.pair.first], side_.data(), motions(row[0]),
                                            motions(row[1]), block.looked, Pack{} + h);
  Pack column[double_lanes] = {given.impulse.x, given.impulse.y, given.twist_a, given.twist_b};
  transpose(column);
  for (int l = 0; l < double_lanes; ++l) {
    if (!block.looked[l]) continue;
    const std::int32_t id = block.id[l];
    __builtin_memcpy(static_cast<void*>(&push[id]), &column[l], sizeof column[l]);
    presses[id] = given.presses[l] != 0;
    if (given.presses[l]) pressed_.push_back(id);
  }
  block.active = false;
}

GEM_CLONES void PairBlocks::press(double h, std::vector<PairPush>& push, std::vector<std::uint8_t>& presses) {
  pressed_.clear();
  for (Block& block : block_)
    if (block.active) press_block(block, h, push, presses);
}

SubPair<double> PairBlocks::sums(PairLane at) const {
  const SubPair<Pack>& from = block_[at.block].pair;
  const int l = at.lane;
  SubPair<double> s;
  s.impulse = get(from.impulse, l);
  s.normal_part = get(from.normal_part, l);
  s.moment = from.moment[l];
  s.twist_a = from.twist_a[l];
  s.pressed = from.pressed[l];
  s.softened = from.softened[l];
  s.point = get(from.point, l);
  s.deepest = from.deepest[l];
  s.most_elastic = from.most_elastic[l];
  s.work = {from.work.stored[l], from.work.crushed[l], from.work.damped[l], from.work.friction[l]};
  s.largest_force = from.largest_force[l];
  s.chord_2 = from.chord_2[l];
  s.depth = from.depth[l];
  s.corners = from.corners[l];
  return s;
}

CornerMemory PairBlocks::memory(PairLane at, int corner) const {
  const SubMemory<Pack>& m = corner_of(at, corner).memory;
  const int l = at.lane;
  return {m.crushed[l],
          m.stretch[l],
          m.stiffness[l],
          m.elastic[l],
          m.normal[l],
          m.side[l],
          static_cast<std::int64_t>(m.pressed_side[l])};
}

}  // namespace gem
