// Makes a dense field by cutting a distorted net into floes.
#include "validation/hard/tight_field.h"

#include <cmath>

#include "gem/base/random.h"

namespace gem::hard {
namespace {

constexpr double pitch = 10.0;  // [m]
constexpr double cover = 0.9;

/// Node of the net. Inside, it is shifted by up to 2 m in both directions; at the sides only along them.
Vec2 knot(int column, int row, int columns, int rows) {
  const auto id = static_cast<std::uint32_t>(row * (columns + 1) + column);
  RandomSequence numbers(Random(19, id));
  const double dx = numbers.uniform(-2.0, 2.0), dy = numbers.uniform(-2.0, 2.0);
  const bool end = column == 0 || column == columns, side = row == 0 || row == rows;
  return {pitch * (column - columns) + (end ? 0.0 : dx), pitch * row + (side ? 0.0 : dy)};
}

FixedDef block(double x0, double y0, double x1, double y1) { return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}; }

}  // namespace

SceneDef tight_scene(int columns, int rows) {
  SceneDef scene;
  scene.run.name = "tight";
  scene.floes.source = FloeSource::listed;
  scene.boundary.present = false;
  scene.platform.present = false;
  const double shrink = std::sqrt(cover);
  for (int c = 0; c < columns; ++c)
    for (int r = 0; r < rows; ++r) {
      FloeDef floe;
      Vec2 middle;
      const Vec2 corners[] = {knot(c, r, columns, rows), knot(c + 1, r, columns, rows),
                              knot(c + 1, r + 1, columns, rows), knot(c, r + 1, columns, rows)};
      for (const Vec2 p : corners) middle += 0.25 * p;
      for (const Vec2 p : corners) floe.outline_m.push_back(shrink * (p - middle));
      floe.position_m = middle;
      scene.floe.push_back(floe);
    }
  const double length = pitch * columns, width = pitch * rows;
  scene.fixed = {block(0.0, -20.0, 20.0, width + 20.0), block(-length - 20.0, -20.0, 0.0, 0.0),
                 block(-length - 20.0, width, 0.0, width + 20.0)};
  return scene;
}

double cover_of(const SceneDef& scene, const Bodies& field) {
  double ice = 0.0;
  for (std::size_t i = 0; i < field.count(); ++i)
    if (field.kind[i] == BodyKind::floe) ice += field.area[i];
  double length = 0.0, width = 0.0;
  for (const FixedDef& fixed : scene.fixed)
    for (const Vec2 p : fixed.outline_m) {
      length = std::fmax(length, -p.x - 20.0);
      width = std::fmax(width, p.y - 20.0);
    }
  return ice / (length * width);
}

}  // namespace gem::hard
