#include "baseline_box2d/touches.h"

#include <algorithm>
#include <cmath>

#include "baseline_box2d/body_of.h"

namespace gem::baseline {

void Touches::clear() {
  pairs_.clear();
  touches_.clear();
  last_.clear();
  read_ = 0;
  points_ = 0;
}

void Touches::PreSolve(b2Contact* contact, const b2Manifold*) {
  const int count = contact->GetManifold()->pointCount;
  if (count == 0) return;
  const auto first = static_cast<std::int32_t>(index_of(*contact->GetFixtureA()));
  const auto second = static_cast<std::int32_t>(index_of(*contact->GetFixtureB()));
  const std::int32_t a = std::min(first, second), b = std::max(first, second);
  const StepConstants& c = field_.constants;
  const double of_pair = friction_of_pair(c.events, a == 0);
  contact->SetFriction(
      static_cast<float>(options_.mixes_friction ? std::sqrt(of_pair * c.events.ice.friction_ice) : of_pair));
  contact->SetRestitutionThreshold(static_cast<float>(options_.restitution_threshold_m_per_s));
  pairs_.push_back({a, b});
  points_ += count;
  if (!options_.measures_quality && field_.bodies.kind[a] == BodyKind::floe)
    return;  // platform and fixed bodies come before the floes

  Touch touch{contact, a, b, {}, count, {}};
  b2WorldManifold manifold;
  contact->GetWorldManifold(&manifold);
  touch.normal = first == a ? from_box2d(manifold.normal) : -from_box2d(manifold.normal);
  for (int k = 0; k < count; ++k) touch.point[k] = from_box2d(manifold.points[k]);
  if (options_.continuous) last_[contact] = touches_.size();
  touches_.push_back(touch);
}

void Touches::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
  if (!options_.continuous) return;
  const auto found = last_.find(contact);
  if (found == last_.end()) return;
  Touch& touch = touches_[found->second];
  for (int k = 0; k < std::min(touch.count, static_cast<int>(impulse->count)); ++k) {
    touch.normal_impulse[k] += static_cast<double>(impulse->normalImpulses[k]);
    touch.tangent_impulse[k] -= static_cast<double>(impulse->tangentImpulses[k]);
  }
}

void Touches::read_impulses() {
  if (options_.continuous) return;
  for (; read_ < touches_.size(); ++read_) {
    Touch& touch = touches_[read_];
    for (int k = 0; k < touch.count; ++k) {
      const b2ManifoldPoint& point = touch.contact->GetManifold()->points[k];
      touch.normal_impulse[k] = static_cast<double>(point.normalImpulse);
      // Box2D's tangent is the normal turned right. Swapping the bodies turns both the normal and the force.
      touch.tangent_impulse[k] = -static_cast<double>(point.tangentImpulse);
    }
  }
}

void Touches::sort() {
  std::stable_sort(touches_.begin(), touches_.end(),
                   [](const Touch& p, const Touch& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
}

}  // namespace gem::baseline
