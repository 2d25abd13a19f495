// Fills rows by four lines each: along a line the covered part of every pixel is exact.
#include "gem/film/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gem/film/stroke_font.h"

namespace gem::film {

namespace {

constexpr int lines_a_row = 4;
constexpr double far_px = 1e6;  // beyond it a corner is moved: differences keep their digits

bool is_finite(const std::vector<Vec2>& points) {
  return std::all_of(points.begin(), points.end(), [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

/// Where the outline crosses the height `y`, ascending.
void crossings(const std::vector<Vec2>& corners, double y, std::vector<double>& found) {
  found.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 p = corners[i], q = corners[i + 1 < corners.size() ? i + 1 : 0];
    if ((p.y <= y) == (q.y <= y)) continue;
    found.push_back(p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y));
  }
  std::sort(found.begin(), found.end());
}

}  // namespace

Canvas::Canvas(int width, int height)
    : width_(width), height_(height), pixels_(std::size_t(3) * width * height), coverage_(width) {}

void Canvas::clear(Colour colour) {
  for (std::size_t i = 0; i < pixels_.size(); i += 3) {
    pixels_[i] = colour.red;
    pixels_[i + 1] = colour.green;
    pixels_[i + 2] = colour.blue;
  }
}

void Canvas::cover(double from, double to, double weight) {
  from = std::clamp(from, 0.0, double(width_));
  to = std::clamp(to, 0.0, double(width_));
  if (!(to > from)) return;
  const int first = std::min(int(from), width_ - 1), last = std::min(int(to), width_ - 1);
  if (first == last) {
    coverage_[first] += float(weight * (to - from));
    return;
  }
  coverage_[first] += float(weight * (first + 1 - from));
  for (int x = first + 1; x < last; ++x) coverage_[x] += float(weight);
  coverage_[last] += float(weight * (to - last));
}

void Canvas::blend_row(int y, int first, int last, Colour colour) {
  std::uint8_t* pixel = &pixels_[std::size_t(3) * (std::size_t(y) * width_ + first)];
  const std::array<std::uint8_t, 3> parts = {colour.red, colour.green, colour.blue};
  for (int x = first; x <= last; ++x, pixel += 3) {
    const float share = std::min(1.0F, coverage_[x]);
    coverage_[x] = 0.0F;
    if (share <= 0.0F) continue;
    for (int k = 0; k < 3; ++k)
      pixel[k] = std::uint8_t(std::lround(float(pixel[k]) + share * (float(parts[k]) - float(pixel[k]))));
  }
}

void Canvas::fill(const std::vector<Vec2>& corners, Colour colour) {
  if (corners.size() < 3 || !is_finite(corners)) return;
  std::vector<Vec2> kept;
  for (const Vec2 p : corners) kept.push_back({std::clamp(p.x, -far_px, far_px), std::clamp(p.y, -far_px, far_px)});
  const auto by_x = [](Vec2 p, Vec2 q) { return p.x < q.x; };
  const auto by_y = [](Vec2 p, Vec2 q) { return p.y < q.y; };
  const auto [left, right] = std::minmax_element(kept.begin(), kept.end(), by_x);
  const auto [top, bottom] = std::minmax_element(kept.begin(), kept.end(), by_y);
  if (right->x <= 0.0 || left->x >= width_) return;
  const int first = std::clamp(int(std::floor(left->x)), 0, width_ - 1);
  const int last = std::clamp(int(std::floor(right->x)), 0, width_ - 1);
  const int first_row = std::max(0, int(std::floor(top->y)));
  const int last_row = std::min(height_ - 1, int(std::floor(bottom->y)));
  std::vector<double> crossed;
  for (int y = first_row; y <= last_row; ++y) {
    for (int k = 0; k < lines_a_row; ++k) {
      crossings(kept, y + (k + 0.5) / lines_a_row, crossed);
      for (std::size_t i = 0; i + 1 < crossed.size(); i += 2) cover(crossed[i], crossed[i + 1], 1.0 / lines_a_row);
    }
    blend_row(y, first, last, colour);
  }
}

void Canvas::line(const std::vector<Vec2>& points, double width, Colour colour, bool closed) {
  const std::size_t parts = points.size() < 2 ? 0 : closed ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < parts; ++i) {
    const Vec2 p = points[i], q = points[i + 1 < points.size() ? i + 1 : 0];
    const double size = length(q - p);
    if (!(size > 0.0)) continue;
    const Vec2 along = (0.5 * width / size) * (q - p), across = turned_left(along);
    // a little longer than the part, so that two parts join
    const Vec2 begin = p - 0.5 * along, end = q + 0.5 * along;
    fill({begin + across, end + across, end - across, begin - across}, colour);
  }
}

double Canvas::text_width(const std::string& text, double height) {
  return double(text.size()) * letter_advance * height / letter_height;
}

void Canvas::text(const std::string& text, Vec2 at, double height, Colour colour) {
  const double scale = height / letter_height, pen = std::max(1.0, 0.13 * height);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Vec2 corner = {at.x + double(i) * letter_advance * scale, at.y - height};
    for (const std::vector<Vec2>& stroke : strokes_of(text[i])) {
      std::vector<Vec2> points;
      for (const Vec2 p : stroke) points.push_back(corner + scale * p);
      line(points, pen, colour);
    }
  }
}

}  // namespace gem::film
