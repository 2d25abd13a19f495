// Compares every piece with all others.
#include "gem/field/platform_pieces.h"

#include <string>
#include <vector>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/geometry/polygon.h"

namespace gem {

void check_platform_pieces(const PlatformDef& platform) {
  const auto name = [](std::size_t i) { return "platform.piece[" + std::to_string(i) + "]"; };
  std::vector<std::vector<Vec2>> pieces;
  for (std::size_t i = 0; i < platform.piece.size(); ++i)
    pieces.push_back(check_outline(platform.piece[i].outline_m, name(i) + ".outline_m", piece_rule).outline);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      const double separation = convex_separation(pieces[i], pieces[j]);
      if (separation >= -piece_touch) continue;
      throw Error(ExitCode::scene_rejected, name(j) + ": overlaps " + name(i) + " (by " + number_text(-separation, 4) +
                                                " m, allowed at most " + number_text(piece_touch) +
                                                " m: the area of both would count twice); cut the pieces so that they "
                                                "touch or stand apart");
    }
}

std::vector<PieceCorner> corners_of_pieces(const Bodies& bodies) {
  std::vector<std::vector<Vec2>> pieces;
  for (std::int32_t i = 0; i < platform_bodies(bodies); ++i)
    pieces.emplace_back(bodies.vertex.begin() + bodies.vertex_begin[i],
                        bodies.vertex.begin() + bodies.vertex_begin[i + 1]);
  return piece_corners(pieces);
}

}  // namespace gem
