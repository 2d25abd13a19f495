// Plane vectors of numbers or of packs (pack.h), with the arithmetic of vec2.h.
#pragma once

#include "gem/base/macros.h"

namespace gem {

template <class Real>
struct alignas(sizeof(Real)) VecOf {
  Real x{}, y{};
};

template <class Real>
GEM_HD GEM_INLINE VecOf<Real> operator+(VecOf<Real> a, VecOf<Real> b) {
  return {a.x + b.x, a.y + b.y};
}
template <class Real>
GEM_HD GEM_INLINE VecOf<Real> operator-(VecOf<Real> a, VecOf<Real> b) {
  return {a.x - b.x, a.y - b.y};
}
template <class Real>
GEM_HD GEM_INLINE VecOf<Real> operator*(Real s, VecOf<Real> a) {
  return {s * a.x, s * a.y};
}
template <class Real>
GEM_HD GEM_INLINE VecOf<Real>& operator+=(VecOf<Real>& a, VecOf<Real> b) {
  return a = a + b;
}
template <class Real>
GEM_HD GEM_INLINE Real dot(VecOf<Real> a, VecOf<Real> b) {
  return a.x * b.x + a.y * b.y;
}
template <class Real>
GEM_HD GEM_INLINE Real cross(VecOf<Real> a, VecOf<Real> b) {
  return a.x * b.y - a.y * b.x;
}
/// spin x r: velocity at arm r of a body with `spin` [rad/s].
template <class Real>
GEM_HD GEM_INLINE VecOf<Real> cross(Real spin, VecOf<Real> r) {
  return {-spin * r.y, spin * r.x};
}
template <class Real>
GEM_HD GEM_INLINE VecOf<Real> turned_left(VecOf<Real> a) {
  return {-a.y, a.x};
}
template <class Mask, class Real>
GEM_HD GEM_INLINE VecOf<Real> pick(Mask mask, VecOf<Real> a, VecOf<Real> b) {
  return {pick(mask, a.x, b.x), pick(mask, a.y, b.y)};
}

}  // namespace gem
