// A picture in memory that polygons, lines and texts are drawn into, with smooth edges.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gem/base/vec2.h"

namespace gem::film {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// Places are in pixels from the upper left corner, y down. What lies outside is left out.
class Canvas {
 public:
  Canvas(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Red, green, blue of each pixel, row by row from the top.
  const std::vector<std::uint8_t>& pixels() const { return pixels_; }

  void clear(Colour colour);
  /// Fills a polygon; where it overlaps itself, by the even-odd rule. Corners that are no numbers: nothing is drawn.
  void fill(const std::vector<Vec2>& corners, Colour colour);
  /// Draws a line through the points, `width` pixels wide. `closed`: back to the first.
  void line(const std::vector<Vec2>& points, double width, Colour colour, bool closed = false);
  /// Writes a text of letters `height` pixels high; `at` is the lower left corner. What the font lacks becomes `?`.
  void text(const std::string& text, Vec2 at, double height, Colour colour);
  /// Width of a text [pixels].
  static double text_width(const std::string& text, double height);

 private:
  void cover(double from, double to, double weight);
  void blend_row(int y, int first, int last, Colour colour);

  int width_, height_;
  std::vector<std::uint8_t> pixels_;
  std::vector<float> coverage_;  // of a row that is being filled
};

}  // namespace gem::film
