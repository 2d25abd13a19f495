// The drag of one floe is a long chain of dependent operations. A branch-free loop over many floes lets the compiler
// vectorise it. The results equal floe_drag() bit for bit.
#include "gem/engine/cpu/kick_floes.h"

#include <algorithm>

#include "gem/base/choose.h"
#include "gem/base/macros.h"
#include "gem/engine/step/solo_stages.h"

namespace gem {
namespace {

/// Floes per block: its arrays stay in the first-level cache. Chosen by hand; affects only speed.
constexpr int block_size = 64;

/// Shares of the quadratic drag law, for the slips or the spins of a block of floes.
struct BlockShares {
  double reach[block_size];
  DragShares shares[block_size];

  void work_out(int count, double dt) {
    for (int j = 0; j < count; ++j) shares[j] = drag_shares(reach[j], strict::log1p_short(reach[j]), dt);
  }
  /// Whether the shares are valid. A long time step, or a floe without slip, is left to the general law.
  bool hold(int j) const { return reach[j] > 0.0 && reach[j] < strict::short_argument; }
};

GEM_CLONES void kick_block(FieldState& f, std::int64_t begin, int count) {
  const Events& e = f.constants.events;
  const Vec2 water = f.drive.water;
  const Bodies& b = f.bodies;
  BlockShares slips, spins;
  for (int j = 0; j < count; ++j) {
    const std::int64_t i = begin + j;
    slips.reach[j] = drag_reach(b.drag[i], length(water - b.velocity[i]), e.dt);
    spins.reach[j] = drag_reach(b.spin_drag[i], magnitude(b.spin[i]), e.dt);
  }
  slips.work_out(count, e.dt);
  spins.work_out(count, e.dt);
  for (int j = 0; j < count; ++j) {
    const std::int64_t i = begin + j;
    if (b.kind[i] != BodyKind::floe || !b.active[i]) continue;
    const Vec2 slip = water - b.velocity[i];
    apply_kick(f, i,
               {slips.hold(j) ? shared_out(slips.shares[j], slip) : drag_quadratic(b.drag[i], slip, length(slip), e.dt),
                spins.hold(j) ? shared_out(spins.shares[j], b.spin[i])
                              : spin_drag_quadratic(b.spin_drag[i], b.spin[i], e.dt)});
  }
}

}  // namespace

void kick_floes(FieldState& f, std::int64_t begin, std::int64_t end) {
  // skips the platform, which another thread may be moving
  while (begin < end && f.bodies.kind[begin] != BodyKind::floe) ++begin;
  if (only_drags_floes(f.constants.events)) {
    for (std::int64_t i = begin; i < end; i += block_size)
      kick_block(f, i, static_cast<int>(std::min<std::int64_t>(block_size, end - i)));
    return;
  }
  for (std::int64_t i = begin; i < end; ++i)
    if (f.bodies.kind[i] == BodyKind::floe) kick_floe(f, i);
}

}  // namespace gem
