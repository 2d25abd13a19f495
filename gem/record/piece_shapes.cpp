// Copies what the file tells of a piece.
#include "gem/record/piece_shapes.h"

#include "gem/field/floe_reserve.h"
#include "gem/record/schema.h"

namespace gem {

void PieceShapes::add(const Bodies& b, std::size_t piece) {
  const std::size_t floe = gem::first_floe(b);
  if (vertex_count.empty()) {
    first_floe = piece - floe;
    first_vertex = static_cast<std::size_t>(b.vertex_begin[piece] - b.vertex_begin[floe]);
  }
  for (std::int32_t v = b.vertex_begin[piece]; v < b.vertex_begin[piece + 1]; ++v) {
    vertex_xy.push_back(b.vertex[static_cast<std::size_t>(v)].x);
    vertex_xy.push_back(b.vertex[static_cast<std::size_t>(v)].y);
  }
  vertex_count.push_back(b.vertex_count(piece));
  area.push_back(b.area[piece]);
  thickness.push_back(b.thickness[piece]);
  mass.push_back(b.mass[piece]);
  inertia.push_back(b.inertia[piece]);
  ice_class.push_back(b.ice_class[piece]);
}

std::vector<std::pair<std::string, const std::vector<double>*>> PieceShapes::columns() const {
  return {{"vertex_count", &vertex_count}, {"area", &area},      {"thickness", &thickness}, {"mass", &mass},
          {"inertia", &inertia},           {"class", &ice_class}};
}

PieceShapes pieces_of(const Bodies& bodies, std::size_t first) {
  PieceShapes pieces;
  for (std::size_t i = first; i < first_unborn(bodies); ++i) pieces.add(bodies, i);
  return pieces;
}

}  // namespace gem
