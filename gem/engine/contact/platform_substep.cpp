#include "gem/engine/contact/platform_substep.h"

namespace gem {

void find_hidden(const FieldState& f, std::vector<std::uint8_t>& hidden_side, std::vector<std::uint8_t>& no_corner) {
  for (std::size_t v = 0; v < f.piece_corner.size(); ++v) {
    const PieceCorner& corner = f.piece_corner[v];
    hidden_side[v] = corner.is_inside;
    no_corner[v] = corner.is_joint && !corner.has_normal;
    for (std::size_t u = 0; u < v && !no_corner[v]; ++u)
      no_corner[v] = length(f.bodies.vertex[u] - f.bodies.vertex[v]) < piece_touch;
  }
}

}  // namespace gem
