// Compares every corner and side of a piece with all other pieces.
#include "gem/geometry/piece_joints.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gem {
namespace {

using Outlines = std::vector<std::vector<Vec2>>;

Vec2 corner_of(const std::vector<Vec2>& outline, std::size_t k) { return outline[k % outline.size()]; }

Vec2 side_normal(const std::vector<Vec2>& outline, std::size_t k) {
  const Vec2 along = corner_of(outline, k + 1) - corner_of(outline, k);
  return (1.0 / length(along)) * turned_right(along);
}

Normals normals_at(const std::vector<Vec2>& outline, std::size_t corner) {
  return {side_normal(outline, corner + outline.size() - 1), side_normal(outline, corner)};
}

/// Distance of p from side k of an outline [m].
double distance_to_side(const std::vector<Vec2>& outline, std::size_t k, Vec2 p) {
  const Vec2 begin = corner_of(outline, k), along = corner_of(outline, k + 1) - begin;
  const double share = std::clamp(dot(p - begin, along) / dot(along, along), 0.0, 1.0);
  return length(p - begin - share * along);
}

/// The normals of an outline at p, if p lies on it.
bool normals_where(const std::vector<Vec2>& outline, Vec2 p, Normals& normals) {
  for (std::size_t k = 0; k < outline.size(); ++k)
    if (length(outline[k] - p) <= piece_touch) return normals = normals_at(outline, k), true;
  for (std::size_t k = 0; k < outline.size(); ++k)
    if (distance_to_side(outline, k, p) <= piece_touch)
      return normals = {side_normal(outline, k), side_normal(outline, k)}, true;
  return false;
}

/// Leaves in `of_all` the normals that `more` has too. Returns whether there are any.
bool keep_common(Normals& of_all, const Normals& more) {
  const bool from_all = more.hold(of_all.first), from_more = of_all.hold(more.first);
  const bool to_all = more.hold(of_all.last), to_more = of_all.hold(more.last);
  if (!(from_all || from_more) || !(to_all || to_more)) return false;
  of_all = {from_all ? of_all.first : more.first, to_all ? of_all.last : more.last};
  return true;
}

PieceCorner corner_among(const Outlines& pieces, std::size_t piece, std::size_t k) {
  PieceCorner corner;
  Normals common = normals_at(pieces[piece], k);
  corner.has_normal = true;
  for (std::size_t other = 0; other < pieces.size(); ++other) {
    Normals there;
    if (other == piece || !normals_where(pieces[other], pieces[piece][k], there)) continue;
    corner.is_joint = true;
    corner.has_normal = corner.has_normal && keep_common(common, there);
  }
  corner.normals = common;
  return corner;
}

/// Whether other pieces lie along the whole of side k: what they cover of it, as shares of its length.
bool is_covered(const Outlines& pieces, std::size_t piece, std::size_t k) {
  const Vec2 begin = pieces[piece][k], along = corner_of(pieces[piece], k + 1) - begin;
  const double size = length(along), near = piece_touch / size;
  const Vec2 outward = side_normal(pieces[piece], k);
  std::vector<std::pair<double, double>> covered;
  for (std::size_t other = 0; other < pieces.size(); ++other) {
    if (other == piece) continue;
    const std::vector<Vec2>& outline = pieces[other];
    for (std::size_t side = 0; side < outline.size(); ++side) {
      const Vec2 p = corner_of(outline, side + 1) - begin, q = outline[side] - begin;  // it runs the other way
      if (std::fabs(dot(outward, p)) > piece_touch || std::fabs(dot(outward, q)) > piece_touch) continue;
      if (dot(p - q, along) < 0.0) covered.emplace_back(dot(p, along) / (size * size), dot(q, along) / (size * size));
    }
  }
  std::sort(covered.begin(), covered.end());
  double end = 0.0;
  for (const auto& [from, to] : covered)
    if (from <= end + near) end = std::max(end, to);
  return end >= 1.0 - near;
}

}  // namespace

std::vector<PieceCorner> piece_corners(const Outlines& pieces) {
  std::vector<PieceCorner> corners;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece)
    for (std::size_t k = 0; k < pieces[piece].size(); ++k) {
      corners.push_back(corner_among(pieces, piece, k));
      corners.back().is_inside = is_covered(pieces, piece, k);
    }
  return corners;
}

}  // namespace gem
