// The checks that the outline of a floe or fixed body must pass.
#include "gem/field/check_outline.h"

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/geometry/convex_pieces.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

[[noreturn]] void refuse_outline(const std::string& name, const std::string& text) {
  throw Error(ExitCode::scene_rejected, name + ": " + text);
}

[[noreturn]] void refuse_vertex(const std::string& name, std::size_t vertex, const std::string& text) {
  refuse_outline(name, "vertex " + std::to_string(vertex) + " (counted from 0) " + text);
}

void check_count(const std::vector<Vec2>& outline, const std::string& name, std::size_t maximum) {
  const std::string count = std::to_string(outline.size());
  if (outline.size() < 3) refuse_outline(name, count + " vertices (an outline needs at least 3); add corners");
  if (outline.size() > maximum)
    refuse_outline(name, count + " vertices (at most " + std::to_string(maximum) + " are allowed); simplify it");
}

void check_points(const std::vector<Vec2>& outline, const std::string& name) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(outline[i].x) || !std::isfinite(outline[i].y))
      refuse_vertex(name, i, "is not finite (a coordinate is infinite or not a number); correct it");
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (outline[i].x == outline[j].x && outline[i].y == outline[j].y)
        refuse_vertex(name, j, "repeats vertex " + std::to_string(i) + " (corners must differ); remove it");
  for (std::size_t i = 0; i < n; ++i) {
    const double edge = length(outline[(i + 1) % n] - outline[i]);
    if (edge < outline_edge_minimum)
      refuse_vertex(name, i,
                    "starts an edge of " + number_text(edge, 4) + " m (the shortest allowed is " +
                        number_text(outline_edge_minimum) + " m); merge the two corners");
  }
}

/// Sine of the turn at each corner: positive to the left, exactly 0 where the outline is practically straight.
std::vector<double> turns_of(const std::vector<Vec2>& outline) {
  const std::size_t n = outline.size();
  std::vector<double> turns(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = outline[i] - outline[(i + n - 1) % n];
    const Vec2 after = outline[(i + 1) % n] - outline[i];
    const double sine = cross(before, after) / (length(before) * length(after));
    turns[i] = std::fabs(sine) < 1e-9 ? 0.0 : sine;
  }
  return turns;
}

void check_corners(const std::vector<double>& turns, const std::string& name) {
  if (std::all_of(turns.begin(), turns.end(), [](double t) { return t == 0.0; }))
    refuse_outline(name, "zero area (all vertices lie on one line); correct the outline");
  for (std::size_t i = 0; i < turns.size(); ++i)
    if (turns[i] == 0.0) refuse_vertex(name, i, "lies on the line of its neighbours (corners must turn); remove it");
}

void check_turns(const std::vector<double>& turns, double area, const std::string& name, const char* where_concave) {
  check_corners(turns, name);
  for (std::size_t i = 0; i < turns.size(); ++i)
    if ((turns[i] > 0.0) != (area > 0.0))
      refuse_vertex(name, i,
                    std::string("turns inwards (the outline is not convex or crosses itself) ") + where_concave);
}

}  // namespace

CheckedOutline check_outline(const std::vector<Vec2>& outline, const std::string& name, const OutlineRule& rule) {
  check_count(outline, name, rule.corners_maximum);
  check_points(outline, name);
  const double area = polygon_moments(outline).area;
  check_turns(turns_of(outline), area, name, rule.where_concave);
  CheckedOutline checked{outline, area < 0.0};
  if (checked.reversed) std::reverse(checked.outline.begin(), checked.outline.end());
  const int winding = first_non_convex_vertex(checked.outline);
  if (winding >= 0) {
    const auto vertex = static_cast<std::size_t>(winding);
    refuse_vertex(name, checked.reversed ? outline.size() - 1 - vertex : vertex,
                  "winds around a second time (the outline crosses itself); correct the order of the corners");
  }
  return checked;
}

CheckedOutline check_simple_outline(const std::vector<Vec2>& outline, const std::string& name,
                                    std::size_t corners_maximum) {
  check_count(outline, name, corners_maximum);
  check_points(outline, name);
  check_corners(turns_of(outline), name);
  const CrossingEdges crossing = crossing_edges(outline);
  if (crossing.first < outline.size())
    refuse_vertex(name, crossing.first,
                  "starts an edge that meets the edge from vertex " + std::to_string(crossing.second) +
                      " (the outline crosses or touches itself); correct it");
  CheckedOutline checked{outline, polygon_moments(outline).area < 0.0};
  if (checked.reversed) std::reverse(checked.outline.begin(), checked.outline.end());
  return checked;
}

}  // namespace gem
