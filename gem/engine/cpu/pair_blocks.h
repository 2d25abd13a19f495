// Pairs that press, side by side: the substep of a pair (gem/engine/contact/sub_pair.h) on packs.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/engine/contact/sub_pair.h"

namespace gem {

/// Where a pair is.
struct PairLane {
  std::int32_t block = -1, lane = 0;
};

/// A corner as its lane is filled.
struct CornerAtStart {
  bool of_b = false;
  Tip tip;
  Vec2 between;     // see SubCorner
  Surface surface;  // of q
  std::int32_t first_side = 0;
  double full_stiffness = 0.0;  // [N/m]
  CornerLaw law;
  CornerMemory memory;
  bool overlapped = false;  // it has a memory
};

/// The motion of a body in this substep. It is copied if it does not stay until press().
struct MotionRow {
  const SubMotion* row = nullptr;
  bool stays = true;
};

class PairBlocks {
 public:
  /// Forgets all pairs.
  void clear();
  /// A free lane for a pair of `corners` corners. `bound`, `exponent`: P0 h^(1+ex) [N], 1 + ex.
  PairLane add(std::int32_t id, int corners, double bound, double exponent);
  void set_corner(PairLane lane, int corner, const CornerAtStart& at_start);

  /// The pair may overlap in this substep.
  void look(PairLane lane, MotionRow a, MotionRow b);
  /// Forces of the pairs that were looked at, into push[id] and presses[id].
  void press(double h, std::vector<PairPush>& push, std::vector<std::uint8_t>& presses);
  /// The pairs that pressed in the last substep.
  const std::vector<std::int32_t>& pressed() const { return pressed_; }

  // what a lane has
  SubPair<double> sums(PairLane lane) const;
  bool overlaps(PairLane lane, int corner) const { return corner_of(lane, corner).overlaps[lane.lane] != 0; }
  bool acted(PairLane lane, int corner) const { return corner_of(lane, corner).acted[lane.lane] != 0; }
  CornerMemory memory(PairLane lane, int corner) const;

 private:
  using Pack = DoublePack;
  using Corner = SubCorner<Pack>;
  struct alignas(64) Block {
    SubPair<Pack> pair;
    MaskOf<Pack> looked{};
    const SubMotion* row[2][double_lanes];  // of a and b; null: own
    SubMotion own[2][double_lanes];
    std::int32_t id[double_lanes];
    std::int32_t filled = 0;  // lanes
    bool active = false;
  };
  const Corner& corner_of(PairLane lane, int corner) const { return corner_[block_[lane.block].pair.first + corner]; }
  void press_block(Block& block, double h, std::vector<PairPush>& push, std::vector<std::uint8_t>& presses);

  std::vector<Block> block_;
  std::vector<Corner> corner_;
  std::vector<SubSide<Pack>> side_;
  std::vector<std::int32_t> filling_;  // per number of corners: the block with free lanes; -1: none
  std::vector<std::int32_t> pressed_;
};

}  // namespace gem
