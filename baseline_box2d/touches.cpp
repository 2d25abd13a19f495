#include "baseline_box2d/touches.h"

#include <algorithm>

#include "baseline_box2d/body_of.h"

namespace gem::baseline {

void Touches::clear() {
  pairs_.clear();
  touches_.clear();
  points_ = 0;
}

void Touches::PreSolve(b2Contact* contact, const b2Manifold*) {
  const int count = contact->GetManifold()->pointCount;
  if (count == 0) return;
  const auto first = static_cast<std::int32_t>(index_of(*contact->GetFixtureA()));
  const auto second = static_cast<std::int32_t>(index_of(*contact->GetFixtureB()));
  const std::int32_t a = std::min(first, second), b = std::max(first, second);
  const MomentConstants& c = field_.constants;
  contact->SetFriction(static_cast<float>(a == 0 ? c.friction_structure : c.friction_ice));
  pairs_.push_back({a, b});
  points_ += count;
  if (!all_ && field_.bodies.kind[a] == BodyKind::floe) return;  // platform and fixed bodies stand before the floes

  Touch touch{contact, a, b, {}, count, {}};
  b2WorldManifold manifold;
  contact->GetWorldManifold(&manifold);
  touch.normal = first == a ? from_box2d(manifold.normal) : -from_box2d(manifold.normal);
  for (int k = 0; k < count; ++k) touch.point[k] = from_box2d(manifold.points[k]);
  touches_.push_back(touch);
}

void Touches::read_impulses() {
  for (Touch& touch : touches_)
    for (int k = 0; k < touch.count; ++k) {
      const b2ManifoldPoint& point = touch.contact->GetManifold()->points[k];
      touch.normal_impulse[k] = static_cast<double>(point.normalImpulse);
      // Box2D's tangent is the normal turned right; swapping the bodies turns both normal and force
      touch.tangent_impulse[k] = -static_cast<double>(point.tangentImpulse);
    }
  std::stable_sort(touches_.begin(), touches_.end(),
                   [](const Touch& p, const Touch& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
}

}  // namespace gem::baseline
