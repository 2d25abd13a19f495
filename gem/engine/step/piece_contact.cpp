// The contact of a piece of the platform: only along normals that the whole outline has.
#include "gem/engine/step/contact_stages.h"
#include "gem/geometry/piece_axis.h"

namespace gem {

ContactGeometry piece_contact(const FieldState& f, std::int32_t a, std::int32_t b, const SeparatingAxes& axes) {
  const Outline outline_a = f.outline(a), outline_b = f.outline(b);
  const Vec2 offset = f.bodies.position[b] - f.bodies.position[a];
  if (f.constants.manifold == Manifold::chord_middle) return chord_contact(outline_a, outline_b, offset, axes.first);
  Separation axis = axes.first;
  const PieceAxis is = find_outer_axis(outline_a, &f.piece_corner[static_cast<std::size_t>(f.bodies.vertex_begin[a])],
                                       f.bodies.rotation[a], outline_b, offset, axis);
  if (is == PieceAxis::none) return {};
  const ContactGeometry geometry = face_contact(outline_a, outline_b, offset, axis, f.constants.contact_margin);
  return is == PieceAxis::replaced && !(geometry.width > 0.0) ? ContactGeometry{} : geometry;
}

}  // namespace gem
