// The contact of a piece of the platform: only along normals that the whole outline has.
#include "gem/engine/step/contact_stages.h"
#include "gem/geometry/piece_axis.h"

namespace gem {

ContactGeometry piece_contact(const FieldState& f, std::int32_t a, std::int32_t b, const SeparatingAxes& axes) {
  const Outline outline_a = f.outline(a), outline_b = f.outline(b);
  const Vec2 offset = f.bodies.position[b] - f.bodies.position[a];
  if (f.constants.manifold == Manifold::chord_middle) return chord_contact(outline_a, outline_b, offset, axes.first);
  return piece_face_contact(outline_a, &f.piece_corner[static_cast<std::size_t>(f.bodies.vertex_begin[a])],
                            f.bodies.rotation[a], outline_b, offset, axes.first, f.constants.contact_margin);
}

}  // namespace gem
