// Convex pieces by ear clipping and joining.
//
//   clip the best ear until a triangle is left
//   for each diagonal that a clip made: join the two pieces at it if the joint is convex and not too large
#include "gem/geometry/convex_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace gem {
namespace {

using Loop = std::vector<std::size_t>;  // indices of corners, counter-clockwise

constexpr double straight = 1e-9;  // sine of a turn that counts as none

/// Sine of the turn at b on the way a, b, c.
double turn(Vec2 a, Vec2 b, Vec2 c) {
  const double size = length(b - a) * length(c - b);
  return size > 0.0 ? cross(b - a, c - b) / size : 0.0;
}

bool in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

struct Triangulation {
  std::vector<Loop> triangles;
  std::vector<std::pair<std::size_t, std::size_t>> diagonals;
};

class EarClipping {
 public:
  explicit EarClipping(const std::vector<Vec2>& outline) : p_(outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) left_.push_back(i);
  }

  std::optional<Triangulation> run() {
    Triangulation result;
    measure_all();
    while (left_.size() > 3) {
      if (best() == left_.size()) measure_all();
      const std::size_t at = best();
      if (at == left_.size()) return std::nullopt;
      const std::size_t before = left_[previous(at)], after = left_[next(at)];
      result.triangles.push_back({before, left_[at], after});
      result.diagonals.emplace_back(before, after);
      left_.erase(left_.begin() + std::ptrdiff_t(at));
      quality_.erase(quality_.begin() + std::ptrdiff_t(at));
      const std::size_t n = left_.size();
      for (const std::size_t i : {(at + n - 1) % n, at % n}) quality_[i] = quality(i);
    }
    if (turn(p_[left_[0]], p_[left_[1]], p_[left_[2]]) <= straight) return std::nullopt;
    result.triangles.push_back(left_);
    return result;
  }

 private:
  std::size_t next(std::size_t i) const { return (i + 1) % left_.size(); }
  std::size_t previous(std::size_t i) const { return (i + left_.size() - 1) % left_.size(); }

  /// Smallest sine of the three turns of the ear at i; 0 if it is no ear.
  double quality(std::size_t i) const {
    const Vec2 a = p_[left_[previous(i)]], b = p_[left_[i]], c = p_[left_[next(i)]];
    const double smallest = std::min({turn(a, b, c), turn(b, c, a), turn(c, a, b)});
    if (smallest <= straight) return 0.0;
    for (std::size_t j = 0; j < left_.size(); ++j)
      if (j != i && j != next(i) && j != previous(i) && in_triangle(p_[left_[j]], a, b, c)) return 0.0;
    return smallest;
  }
  void measure_all() {
    quality_.clear();
    for (std::size_t i = 0; i < left_.size(); ++i) quality_.push_back(quality(i));
  }
  std::size_t best() const {
    const auto most = std::max_element(quality_.begin(), quality_.end());
    return *most > 0.0 ? static_cast<std::size_t>(most - quality_.begin()) : left_.size();
  }

  const std::vector<Vec2>& p_;
  Loop left_;
  std::vector<double> quality_;
};

/// The loop turned so that it begins with the edge a -> b; empty if it has no such edge.
Loop from_edge(const Loop& loop, std::size_t a, std::size_t b) {
  const auto at = std::find(loop.begin(), loop.end(), a);
  if (at == loop.end()) return {};
  Loop turned(at, loop.end());
  turned.insert(turned.end(), loop.begin(), at);
  return turned[1] == b ? turned : Loop{};
}

bool strictly_convex(const std::vector<Vec2>& p, const Loop& loop) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i)
    if (turn(p[loop[(i + n - 1) % n]], p[loop[i]], p[loop[(i + 1) % n]]) <= straight) return false;
  return true;
}

void join(std::vector<Loop>& pieces, const std::vector<Vec2>& p, std::pair<std::size_t, std::size_t> diagonal,
          std::size_t corners_maximum) {
  const auto [a, b] = diagonal;
  const auto with = [&](std::size_t from, std::size_t to) {
    return std::find_if(pieces.begin(), pieces.end(), [&](const Loop& l) { return !from_edge(l, from, to).empty(); });
  };
  const auto one = with(a, b), other = with(b, a);
  if (one == pieces.end() || other == pieces.end()) return;
  Loop joint = from_edge(*one, a, b);
  const Loop rest = from_edge(*other, b, a);  // b, a, ...: its corners go between a and b
  joint.insert(joint.begin() + 1, rest.begin() + 2, rest.end());
  if (joint.size() > corners_maximum || !strictly_convex(p, joint)) return;
  *one = std::move(joint);
  pieces.erase(other);
}

/// Whether the segments a-b and c-d have a point in common.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x)) return false;
  if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) return false;
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  const auto apart = [](double u, double v) { return (u > 0.0 && v > 0.0) || (u < 0.0 && v < 0.0); };
  return !apart(c_side, d_side) && !apart(a_side, b_side);
}

}  // namespace

std::vector<std::vector<Vec2>> convex_pieces(const std::vector<Vec2>& outline, std::size_t corners_maximum) {
  const auto triangulation = EarClipping(outline).run();
  if (!triangulation) return {};
  std::vector<Loop> loops = triangulation->triangles;
  for (const auto& diagonal : triangulation->diagonals) join(loops, outline, diagonal, corners_maximum);
  std::vector<std::vector<Vec2>> pieces;
  for (const Loop& loop : loops) {
    pieces.emplace_back();
    for (const std::size_t i : loop) pieces.back().push_back(outline[i]);
  }
  return pieces;
}

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<Vec2> hull;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t begin = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= begin + 2 && turn(hull[hull.size() - 2], hull.back(), *first) <= straight) hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();  // the next chain begins with it
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

CrossingEdges crossing_edges(const std::vector<Vec2>& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && meet(outline[i], outline[i + 1], outline[j], outline[(j + 1) % n])) return {i, j};
  return {n, n};
}

}  // namespace gem
