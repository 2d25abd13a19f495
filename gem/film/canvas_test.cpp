// Covered areas are exact to a pixel's rounding, and nothing is drawn outside.
#include "gem/film/canvas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace gem::film {
namespace {

/// White that was drawn on black [pixels].
double white_area(const Canvas& canvas) {
  return std::accumulate(canvas.pixels().begin(), canvas.pixels().end(), 0.0) / (3.0 * 255.0);
}

constexpr Colour white = {255, 255, 255};

TEST(Canvas, APolygonCoversItsArea) {
  Canvas canvas(100, 80);
  canvas.fill({{10.3, 20.25}, {50.8, 20.25}, {50.8, 60.5}, {10.3, 60.5}}, white);
  EXPECT_NEAR(white_area(canvas), 40.5 * 40.25, 2.0);  // edges are rounded to 1/255 of a pixel
  Canvas triangle(100, 80);
  triangle.fill({{5.0, 5.0}, {90.0, 40.0}, {20.0, 70.0}}, white);
  EXPECT_NEAR(white_area(triangle), 0.5 * std::abs(85.0 * 65.0 - 15.0 * 35.0), 10.0);  // four lines a row
}

TEST(Canvas, WhatLiesOutsideIsLeftOut) {
  Canvas canvas(40, 30);
  canvas.fill({{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}}, white);
  EXPECT_NEAR(white_area(canvas), 1200.0, 1.0);
  canvas.clear({0, 0, 0});
  canvas.fill({{50.0, 5.0}, {60.0, 5.0}, {55.0, 20.0}}, white);
  canvas.fill({{5.0, -50.0}, {20.0, -50.0}, {10.0, -1.0}}, white);
  const double nan = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
  canvas.fill({{nan, 1.0}, {20.0, 1.0}, {10.0, 20.0}}, white);
  canvas.fill({{endless, 1.0}, {20.0, 1.0}, {10.0, 20.0}}, white);
  canvas.fill({{1.0, 1.0}, {20.0, 20.0}}, white);
  EXPECT_EQ(white_area(canvas), 0.0);
}

TEST(Canvas, LinesAndTextsAreDrawn) {
  Canvas canvas(200, 40);
  canvas.line({{20.0, 20.0}, {120.0, 20.0}}, 4.0, white);
  EXPECT_NEAR(white_area(canvas), 102.0 * 4.0, 2.0);  // a line goes on for a quarter of its width at both ends
  Canvas with_text(200, 40), unknown(200, 40), marks(200, 40);
  with_text.text("12:30 kN", {10.0, 30.0}, 20.0, white);
  EXPECT_GT(white_area(with_text), 100.0);
  unknown.text("\xc3\xbc", {10.0, 30.0}, 20.0, white);
  marks.text("??", {10.0, 30.0}, 20.0, white);
  EXPECT_EQ(unknown.pixels(), marks.pixels());
}

}  // namespace
}  // namespace gem::film
