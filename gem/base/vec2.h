// Plane vectors and unit rotations, with the same arithmetic on host and device.
#pragma once

#include <cmath>

#include "gem/base/macros.h"

namespace gem {

struct alignas(16) Vec2 {
  double x = 0.0;
  double y = 0.0;
};

GEM_HD constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
GEM_HD constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
GEM_HD constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
GEM_HD constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
GEM_HD constexpr Vec2& operator+=(Vec2& a, Vec2 b) { return a = a + b; }
GEM_HD constexpr Vec2& operator-=(Vec2& a, Vec2 b) { return a = a - b; }

GEM_HD constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
GEM_HD constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// spin x r: velocity at arm r of a body with `spin` [rad/s].
GEM_HD constexpr Vec2 cross(double spin, Vec2 r) { return {-spin * r.y, spin * r.x}; }
/// The vector turned by 90 degrees counter-clockwise.
GEM_HD constexpr Vec2 turned_left(Vec2 a) { return {-a.y, a.x}; }
/// The vector turned by 90 degrees clockwise: the outward normal of a counter-clockwise edge.
GEM_HD constexpr Vec2 turned_right(Vec2 a) { return {a.y, -a.x}; }
GEM_HD inline double length(Vec2 a) { return std::sqrt(a.x * a.x + a.y * a.y); }

/// A rotation as cosine and sine, so that a time step needs no trigonometry.
struct alignas(16) Rotation {
  double cosine = 1.0;
  double sine = 0.0;
};

GEM_HD constexpr Vec2 rotate(Rotation q, Vec2 a) {
  return {q.cosine * a.x - q.sine * a.y, q.sine * a.x + q.cosine * a.y};
}

}  // namespace gem
