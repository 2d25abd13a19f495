#include "gem/engine/step/field_state.h"

#include "gem/engine/solver/iteration_control.h"

#include <utility>

#include "gem/engine/step/solo_stages.h"
#include "gem/field/platform_pieces.h"

namespace gem {

FieldState make_field_state(Bodies bodies, const StepConstants& constants) {
  FieldState f;
  const std::size_t n = bodies.count();
  const std::size_t vertices = bodies.vertex.size();
  f.bodies = std::move(bodies);
  f.constants = constants;
  f.drive = steady_drive(constants.events);
  f.corner.resize(vertices);
  f.normal.resize(vertices);
  f.body_normal.resize(vertices);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t begin = f.bodies.vertex_begin[i], end = f.bodies.vertex_begin[i + 1];
    for (std::int32_t v = begin; v < end; ++v) {
      const Vec2 edge = f.bodies.vertex[v + 1 < end ? v + 1 : begin] - f.bodies.vertex[v];
      f.body_normal[v] = (1.0 / length(edge)) * turned_right(edge);
    }
    turn_outline(f, i);
  }
  if (constants.pieces > 1) f.piece_corner = corners_of_pieces(f.bodies);
  f.turn_travel.assign(n, 0.0);
  f.path_correction.assign(n, {});
  f.angle_correction.assign(n, 0.0);
  f.struck.assign(n, 0);
  f.repair_shift.assign(n, {});
  f.repair_turn.assign(n, 0.0);
  if (constants.solver == ContactSolver::coupled) {
    if (constants.iteration == Iteration::gradient)
      f.momentum_coefficients = momentum_coefficients(constants.iterations_maximum);
    for (std::size_t i = 0; i < n; ++i)
      f.crushing.push_back(crushing_powers(constants.events, f.bodies.thickness[i], f.bodies.area[i]));
  }
  f.books.assign(n * static_cast<std::size_t>(Channel::count), {});
  return f;
}

}  // namespace gem
