#include "validation/paper/experiments/unordered_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gem/engine/step/contact_stages.h"

namespace gem::repeats {
namespace {

constexpr std::uint32_t kOrderStream = 7001;

SingleMotion single(Vec2 velocity, double spin) {
  return {static_cast<float>(velocity.x), static_cast<float>(velocity.y), static_cast<float>(spin)};
}

Vec2 velocity_of(SingleMotion m) { return {static_cast<double>(m.x), static_cast<double>(m.y)}; }

}  // namespace

SingleMotion operator+(SingleMotion a, SingleMotion b) { return {a.x + b.x, a.y + b.y, a.spin + b.spin}; }

SingleMotion sum_of(SingleMotion start, const std::vector<SingleMotion>& pushes) {
  for (const SingleMotion& push : pushes) start = start + push;
  return start;
}

void shuffle(std::vector<SingleMotion>& pushes, RandomSequence& random) {
  for (std::size_t left = pushes.size(); left > 1; --left) std::swap(pushes[left - 1], pushes[random.below(left)]);
}

UnorderedEngine::UnorderedEngine(const SceneDef& scene, Bodies bodies, SumStart start, std::uint64_t repeat)
    : CpuEngine(scene, std::move(bodies), 1, EngineOptions{}.contacts_worth_a_thread), start_(start), repeat_(repeat) {}

// On one thread, as requested by the constructor.
void UnorderedEngine::before_contact_events() { keep_motions(); }

void UnorderedEngine::after_contact_events() {
  gather_pushes();
  sum_again();
}

void UnorderedEngine::keep_motions() {
  velocity_ = field().bodies.velocity;
  spin_ = field().bodies.spin;
}

void UnorderedEngine::gather_pushes() {
  const Bodies& b = field().bodies;
  entry_.clear();
  for (const Contact* contact : contacts())
    for (int k = 0; k < contact->count; ++k) {
      const ContactSlot& slot = contact->slot[k];
      if (slot.impulse.normal == 0.0 && slot.impulse.tangential == 0.0) continue;
      const Vec2 impulse = world_impulse(*contact, slot.impulse);
      entry_.push_back({contact->a, velocity_change(collision_mass(b, contact->a), slot.arm_a, -impulse)});
      entry_.push_back({contact->b, velocity_change(collision_mass(b, contact->b), slot.arm_b, impulse)});
    }
  std::stable_sort(entry_.begin(), entry_.end(), [](const Entry& p, const Entry& q) { return p.body < q.body; });
}

void UnorderedEngine::sum_again() {
  RandomSequence random(Random(repeat_, kOrderStream, static_cast<std::uint32_t>(step())));
  const Entry* const end = entry_.data() + entry_.size();
  for (const Entry* first = entry_.data(); first != end;) {
    const Entry* last = first;
    while (last != end && last->body == first->body) ++last;
    sum_body(first->body, first, last, random);
    first = last;
  }
}

void UnorderedEngine::sum_body(std::int32_t i, const Entry* first, const Entry* last, RandomSequence& random) {
  Bodies& b = field().bodies;
  if (b.inverse_mass[i] == 0.0) return;
  const bool on_velocity = start_ == SumStart::velocity;
  const SingleMotion start = on_velocity ? single(velocity_[i], spin_[i]) : SingleMotion{};
  Vec2 exact = on_velocity ? velocity_[i] : Vec2{};
  double size = length(exact);
  pushes_.clear();
  for (const Entry* entry = first; entry != last; ++entry) {
    pushes_.push_back(single(entry->push.velocity, entry->push.spin));
    exact += entry->push.velocity;
    size += length(entry->push.velocity);
  }
  const SingleMotion ordered = sum_of(start, pushes_);
  shuffle(pushes_, random);
  const SingleMotion sum = sum_of(start, pushes_);

  b.velocity[i] = velocity_of(sum) + (on_velocity ? Vec2{} : velocity_[i]);
  b.spin[i] = static_cast<double>(sum.spin) + (on_velocity ? 0.0 : spin_[i]);

  SumStatistics& s = statistics_;
  const double rounding = length(velocity_of(sum) - exact) / size;
  const double order = length(velocity_of(sum) - velocity_of(ordered));
  ++s.sums;
  s.rounding_squares += rounding * rounding;
  s.rounding_largest = std::max(s.rounding_largest, rounding);
  if (pushes_.size() + (on_velocity ? 1 : 0) < 3) return;
  ++s.several;
  if (sum.x != ordered.x || sum.y != ordered.y || sum.spin != ordered.spin) ++s.changed;
  s.order_squares += order * order / (size * size);
  s.order_largest = std::max(s.order_largest, order / size);
  if (i != 0) return;
  ++s.platform_sums;
  s.platform_squares += order * order;
}

}  // namespace gem::repeats
