// Cuts the outline, and gives each piece its share of mass and motion.
#include "gem/field/split_floes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gem/field/check_outline.h"
#include "gem/field/drag_coefficients.h"
#include "gem/field/floe_reserve.h"
#include "gem/geometry/cut_outline.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

/// A corner nearer to the crack than this share of the floe's radius becomes an end of the crack. Chosen by hand.
constexpr double snap_share = 1e-3;

double radius_about(const std::vector<Vec2>& outline, Vec2 centre) {
  double radius = 0.0;
  for (const Vec2 corner : outline) radius = std::max(radius, length(corner - centre));
  return radius;
}

bool is_good_piece(const std::vector<Vec2>& outline, const SceneDef& scene) {
  if (outline.size() < listed_corners_minimum || outline.size() > listed_corners_maximum) return false;
  const PolygonMoments moments = polygon_moments(outline);
  const double least = std::max(scene.breakup.minimum_size_m, floe_size_range.low);
  if (!(moments.area >= least * least) || first_non_convex_vertex(outline) >= 0) return false;
  return radius_about(outline, moments.centroid) <= piece_radius_maximum * std::sqrt(moments.area);
}

std::optional<OutlineCut> good_cut(const Bodies& b, const SceneDef& scene, const FloeCrack& crack) {
  const auto i = static_cast<std::size_t>(crack.floe);
  const std::vector<Vec2> outline(b.vertex.begin() + b.vertex_begin[i], b.vertex.begin() + b.vertex_begin[i + 1]);
  const double snap = std::max(2.0 * outline_edge_minimum, snap_share * b.radius[i]);
  auto cut = cut_outline(outline, crack.point, crack.along, snap);
  if (!cut || !is_good_piece(cut->left, scene) || !is_good_piece(cut->right, scene)) return std::nullopt;
  return cut;
}

/// Puts a piece with a share of the mass of floe i into row k.
void make_piece(Bodies& b, const SceneDef& scene, std::size_t i, std::size_t k, const std::vector<Vec2>& outline,
                double mass) {
  const PolygonMoments moments = polygon_moments(outline);
  for (const Vec2 corner : outline) b.vertex.push_back(corner - moments.centroid);
  b.vertex_begin[k + 1] = static_cast<std::int32_t>(b.vertex.size());
  b.ice_class[k] = b.ice_class[i];
  b.radius[k] = radius_about(outline, moments.centroid);
  b.area[k] = moments.area;
  b.thickness[k] = b.thickness[i];
  b.mass[k] = mass;
  b.inertia[k] = mass * (moments.second_moment / moments.area);
  b.inverse_mass[k] = 1.0 / b.mass[k];
  b.inverse_inertia[k] = 1.0 / b.inertia[k];
  const Vec2 arm = rotate(b.rotation[i], moments.centroid);
  b.position[k] = b.position[i] + arm;
  b.rotation[k] = b.rotation[i];
  b.velocity[k] = b.velocity[i] + cross(b.spin[i], arm);
  b.spin[k] = b.spin[i];
  b.active[k] = 1;
  set_floe_drag(b, k, scene);
}

}  // namespace

std::vector<FloeSplit> split_floes(Bodies& b, const SceneDef& scene, const std::vector<FloeCrack>& cracks) {
  const std::size_t first = first_unborn(b);
  std::size_t row = first;
  const auto begin_of_pieces = static_cast<std::size_t>(b.vertex_begin[first_piece(b, scene)]);
  const std::size_t corners_maximum = begin_of_pieces + piece_corners_maximum(scene);
  std::vector<FloeSplit> splits;
  for (const FloeCrack& crack : cracks) {
    FloeSplit& split = splits.emplace_back();
    split.floe = crack.floe;
    const auto cut = good_cut(b, scene, crack);
    if (!cut) continue;
    if (row + 2 > b.count() || b.vertex.size() + cut->left.size() + cut->right.size() > corners_maximum) {
      split.result = FloeSplit::Result::no_room;
      continue;
    }
    const auto i = static_cast<std::size_t>(crack.floe);
    const double left = polygon_moments(cut->left).area, right = polygon_moments(cut->right).area;
    const double mass = b.mass[i] * (left / (left + right));
    make_piece(b, scene, i, row, cut->left, mass);
    make_piece(b, scene, i, row + 1, cut->right, b.mass[i] - mass);
    b.active[i] = 0;
    split.result = FloeSplit::Result::split;
    split.piece[0] = static_cast<std::int32_t>(row);
    split.piece[1] = static_cast<std::int32_t>(row + 1);
    split.length = cut->length;
    row += 2;
  }
  if (row > first)
    std::fill(b.vertex_begin.begin() + static_cast<std::ptrdiff_t>(row) + 1, b.vertex_begin.end(),
              static_cast<std::int32_t>(b.vertex.size()));
  return splits;
}

}  // namespace gem
