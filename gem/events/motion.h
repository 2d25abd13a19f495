// Rotation of a free body over a time step without trigonometry.
//
//   half = tan(phi/2) = p + p^3/3 + 2 p^5/15,  p = phi/2
//
//   cos phi = (1 - half^2) / (1 + half^2),  sin phi = 2 half / (1 + half^2)
//
// The result is a rotation for any half. Its angle is accurate to about (34/315) p^7: 1.1e-15 rad for phi = 0.02,
// 6.3e-6 rad for phi = 0.5. One Newton step renormalises towards cosine^2 + sine^2 = 1.
#pragma once

#include "gem/base/vec2.h"

namespace gem {

/// `q` turned by `angle` [rad], for |angle| < 0.5.
GEM_HD constexpr Rotation turned(Rotation q, double angle) {
  const double p = 0.5 * angle;
  const double p2 = p * p;
  const double half = p * (1.0 + p2 * (1.0 / 3.0 + p2 * (2.0 / 15.0)));
  const double denominator = 1.0 / (1.0 + half * half);
  const double cosine = (1.0 - half * half) * denominator;
  const double sine = 2.0 * half * denominator;
  const Rotation r{q.cosine * cosine - q.sine * sine, q.sine * cosine + q.cosine * sine};
  const double scale = 1.5 - 0.5 * (r.cosine * r.cosine + r.sine * r.sine);
  return {scale * r.cosine, scale * r.sine};
}

}  // namespace gem
