// A turn is a long chain of dependent operations. A branch-free loop over many floes lets the compiler vectorise it.
#include "gem/engine/cpu/move_floes.h"

#include <algorithm>

#include "gem/base/macros.h"
#include "gem/engine/step/solo_stages.h"

namespace gem {
namespace {

/// Floes per block: its arrays stay in the first-level cache. Chosen by hand; affects only speed.
constexpr int block_size = 64;

GEM_CLONES bool move_block(FieldState& f, std::int64_t begin, int count) {
  const Bodies& b = f.bodies;
  double angle[block_size];
  Rotation turned_to[block_size];
  for (int j = 0; j < count; ++j)
    angle[j] = b.kind[begin + j] == BodyKind::floe && b.active[begin + j] ? shift_floe(f, begin + j) : 0.0;
  for (int j = 0; j < count; ++j) turned_to[j] = turned(b.rotation[begin + j], angle[j]);
  bool finite = true;
  for (int j = 0; j < count; ++j) {
    const std::int64_t i = begin + j;
    if (b.kind[i] != BodyKind::floe) continue;
    if (angle[j] != 0.0) apply_turn(f, i, angle[j], turned_to[j]);
    if (finite_or_inactive(b, i))
      retire_floe(f, i);
    else
      finite = false;
  }
  return finite;
}

}  // namespace

bool move_floes(FieldState& f, std::int64_t begin, std::int64_t end) {
  bool finite = true;
  for (std::int64_t i = begin; i < end; i += block_size)
    finite &= move_block(f, i, static_cast<int>(std::min<std::int64_t>(block_size, end - i)));
  return finite;
}

}  // namespace gem
