// Merges sorted lists of contacts; finds for each floe the load that splits it.
#include "gem/engine/breakup/contact_loads.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "gem/geometry/cut_outline.h"

namespace gem {
namespace {

bool stands_before(const ContactLoad& p, const ContactLoad& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); }

void add_to(ContactLoad& sum, const ContactLoad& more) {
  sum.impulse += more.impulse;
  sum.weight += more.weight;
  sum.arm_a += more.arm_a;
  sum.arm_b += more.arm_b;
}

/// Merges two lists that ascend in (a, b).
void merge(const std::vector<ContactLoad>& p, const std::vector<ContactLoad>& q, std::vector<ContactLoad>& out) {
  out.clear();
  auto i = p.begin(), j = q.begin();
  while (i != p.end() || j != q.end()) {
    if (j == q.end() || (i != p.end() && stands_before(*i, *j))) {
      out.push_back(*i++);
    } else if (i == p.end() || stands_before(*j, *i)) {
      out.push_back(*j++);
    } else {
      out.push_back(*i++);
      add_to(out.back(), *j++);
    }
  }
}

/// The crack that a load makes in floe i; nothing if it does not split. `force` acts on the floe, in its axes.
std::optional<LoadedCrack> crack_of(const BreakupDef& def, const Bodies& b, std::int32_t i, Vec2 point, Vec2 force) {
  const double depth = length(point);  // of the centroid below the contact
  if (!(depth > 0.0)) return std::nullopt;
  const Vec2 along = (-1.0 / depth) * point;
  const double push = dot(force, along);
  // the centroid of a convex outline lies within the middle third of any chord through it
  if (!(push > splitting_force(def, b.thickness[i], 1.5 * depth))) return std::nullopt;
  const std::vector<Vec2> outline(b.vertex.begin() + b.vertex_begin[i], b.vertex.begin() + b.vertex_begin[i + 1]);
  const auto cut = cut_outline(outline, point, along, 0.0);
  if (!cut) return std::nullopt;
  const double bears = splitting_force(def, b.thickness[i], cut->length);
  if (!(push > bears)) return std::nullopt;
  return LoadedCrack{{i, point, along}, push, bears};
}

std::int64_t half_steps(const SceneDef& scene) {
  return std::max<std::int64_t>(1, std::llround(0.5 * scene.breakup.load_time_s / scene.numerics.time_step_s));
}

}  // namespace

ContactLoads::ContactLoads(const SceneDef& scene)
    : def_(scene.breakup), dt_(scene.numerics.time_step_s), half_steps_(half_steps(scene)) {}

void ContactLoads::add(const std::vector<StepForce>& forces) {
  for (auto from = forces.begin(); from != forces.end();) {
    const auto to = std::find_if(from, forces.end(), [&](const StepForce& f) { return f.step != from->step; });
    add_step({from, to});
    from = to;
  }
}

void ContactLoads::add_step(std::span<const StepForce> forces) {
  std::vector<ContactLoad> step;
  for (const StepForce& f : forces) {
    const Vec2 impulse = dt_ * f.force.force;
    const double weight = length(impulse);
    step.push_back({f.force.a, f.force.b, impulse, weight, weight * f.arm_a, weight * f.arm_b});
  }
  merge(sums_.now, step, scratch_);
  sums_.now.swap(scratch_);
}

std::vector<LoadedCrack> ContactLoads::close_half(const Bodies& b) {
  merge(sums_.before, sums_.now, scratch_);
  const double per_second = 1.0 / (2.0 * double(half_steps_) * dt_);
  std::vector<LoadedCrack> cracks;
  const auto look_at = [&](std::int32_t i, Vec2 arm, Vec2 force) {
    if (b.kind[i] != BodyKind::floe || !b.active[i]) return;
    const Rotation q = b.rotation[i];
    const auto crack = crack_of(def_, b, i, arm, rotate({q.cosine, -q.sine}, force));
    if (crack) cracks.push_back(*crack);
  };
  for (const ContactLoad& load : scratch_) {
    if (!(load.weight > 0.0)) continue;
    const Vec2 force = per_second * load.impulse;
    look_at(load.a, (1.0 / load.weight) * load.arm_a, -1.0 * force);
    look_at(load.b, (1.0 / load.weight) * load.arm_b, force);
  }
  std::stable_sort(cracks.begin(), cracks.end(), [](const LoadedCrack& p, const LoadedCrack& q) {
    if (p.crack.floe != q.crack.floe) return p.crack.floe < q.crack.floe;
    return p.force * q.splitting_force > q.force * p.splitting_force;
  });
  const auto same_floe = [](const LoadedCrack& p, const LoadedCrack& q) { return p.crack.floe == q.crack.floe; };
  cracks.erase(std::unique(cracks.begin(), cracks.end(), same_floe), cracks.end());
  sums_.before.swap(sums_.now);
  sums_.now.clear();
  return cracks;
}

void ContactLoads::drop_inactive(const Bodies& b) {
  for (std::vector<ContactLoad>* loads : {&sums_.before, &sums_.now})
    loads->erase(std::remove_if(loads->begin(), loads->end(),
                                [&](const ContactLoad& load) { return !b.active[load.a] || !b.active[load.b]; }),
                 loads->end());
}

}  // namespace gem
