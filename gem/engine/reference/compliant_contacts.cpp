#include "gem/engine/reference/compliant_contacts.h"

#include <algorithm>
#include <cmath>

#include "gem/engine/reference/reference_books.h"
#include "gem/engine/reference/reference_motion.h"

namespace gem::reference {
namespace {

/// Substeps of a time step: kappa min sqrt(m / (12 k)) long over the floes without the lightest 1 % of the area, or
/// shorter if the scene says so.
std::int64_t substeps_of(const SceneDef& scene, const Bodies& b) {
  std::multimap<double, double> areas;  // by the longest substep
  double total = 0.0;
  for (std::size_t i = 0; i < b.count(); ++i) {
    if (b.kind[i] != BodyKind::floe) continue;
    const double k = corner_stiffness(scene.contact, b.thickness[i], true);
    areas.emplace(stable_kappa * std::sqrt(b.mass[i] / (12.0 * k)), b.area[i]);
    total += b.area[i];
  }
  std::int64_t needed = 1;
  double lighter = 0.0;
  for (const auto& [longest, area] : areas) {
    lighter += area;
    if (lighter <= 0.01 * total) continue;
    needed = std::max(needed, static_cast<std::int64_t>(std::ceil(scene.numerics.time_step_s / longest)));
    break;
  }
  return std::max(needed, scene.numerics.substeps);
}

Vec2 velocity_at(const Bodies& b, std::int32_t i, Vec2 place) {
  return b.velocity[i] + cross(b.spin[i], place - b.position[i]);
}

/// Energy in the spring of a corner [J].
double stored(const CornerMemory& m) { return 0.5 * m.stiffness * (m.elastic * m.elastic + m.stretch * m.stretch); }

/// Books that the spring of a corner loses the energy `lost` [J].
void lose(double lost, ContactEnergy& energy) {
  energy.stored -= lost;
  energy.damped += lost;
}

/// Books what a fixed body, a fixed platform or a yaw lock gives to a corner's body p, whose opposite acts on q.
void book_ground(State& s, const CornerInside& at, Vec2 normal_part, Vec2 tangential_part) {
  const Bodies& b = s.bodies;
  const Vec2 on_p = normal_part + tangential_part;
  for (const std::int32_t i : {at.p, at.q}) {
    const double sign = i == at.p ? -1.0 : 1.0;  // of what i gives to the other body
    if (b.kind[i] == BodyKind::fixed) {
      Quantity &impact = s.ledger[Channel::impact], &friction = s.ledger[Channel::friction];
      impact.momentum += sign * normal_part;
      impact.angular_momentum += sign * cross(at.place, normal_part);
      friction.momentum += sign * tangential_part;
      friction.angular_momentum += sign * cross(at.place, tangential_part);
    }
    if (b.kind[i] != BodyKind::platform) continue;
    if (b.inverse_inertia[i] == 0.0)
      s.ledger.mooring_force.angular_momentum += sign * cross(at.place - b.position[i], on_p);
    if (b.inverse_mass[i] > 0.0) continue;
    s.mooring_impulse += sign * on_p;
    s.ledger.mooring_force.momentum += sign * on_p;
    s.ledger.mooring_force.angular_momentum += sign * cross(b.position[i], on_p);
  }
}

}  // namespace

CompliantContacts::CompliantContacts(const SceneDef& scene, const Bodies& bodies, int refinement)
    : refinement_(refinement) {
  check_one_piece(bodies, "reference");
  set_substeps(scene, bodies, substeps_of(scene, bodies));
}

void CompliantContacts::set_substeps(const SceneDef& scene, const Bodies& bodies, std::int64_t of_scene) {
  of_scene_ = of_scene;
  SceneDef shorter = scene;
  shorter.numerics.time_step_s /= static_cast<double>(of_scene * refinement_);
  h_ = shorter.numerics.time_step_s;
  of_substep_ = rules_of(shorter, bodies);
  of_substep_.tow_rate = 0.0;  // the tow acts between time steps
}

void CompliantContacts::save(EngineState& state) const {
  for (const auto& [key, corner] : memory_) {
    state.corner_key.push_back(key);
    state.corner_value.push_back(corner);
  }
  state.substeps = of_scene_;
}

void CompliantContacts::restore(const SceneDef& scene, const EngineState& state) {
  if (state.substeps > 0) set_substeps(scene, state.bodies, state.substeps);
  memory_.clear();
  for (std::size_t k = 0; k < state.corner_key.size(); ++k) memory_[state.corner_key[k]] = state.corner_value[k];
}

std::vector<Touch> CompliantContacts::advance(const Rules& rules, State& s, StepQuality& quality, StepLog& log) {
  const Bodies start = s.bodies;
  const double left = s.ledger.contact.left();
  pairs_.clear();
  tow_platform(rules, s);
  quality.iterations = static_cast<std::int32_t>(of_scene_ * refinement_);
  for (std::int32_t k = 0; k < quality.iterations; ++k) substep(rules, s);
  quality.energy_created = std::max(0.0, s.ledger.contact.left() - left);
  for (const auto& [pair, sum] : pairs_) {
    quality.contacts += static_cast<std::int32_t>(sum.corners.size());
    if (!(sum.most_elastic > 0.0)) continue;
    const double share = sum.most_elastic / std::sqrt(std::min(start.area[pair.first], start.area[pair.second]));
    log.overlap.add(sum.most_elastic);
    log.overlap_share.add(share);
    quality.maximum_overlap = std::max(quality.maximum_overlap, sum.most_elastic);
    quality.maximum_share = std::max(quality.maximum_share, share);
  }
  return touches(start);
}

void CompliantContacts::substep(const Rules& rules, State& s) {
  Bodies& b = s.bodies;
  ContactEnergy& energy = s.ledger.contact;
  std::vector<Push> push(b.count());
  s.struck.assign(b.count(), 0);
  Memory before;
  before.swap(memory_);
  for (const Overlap& overlap : all_overlaps(b)) {
    s.struck[overlap.a] = s.struck[overlap.b] = 1;
    std::vector<Corner> corners = recall(b, overlap, before);
    hand_over(overlap, corners, before, energy);
    press(law_of(rules, b, overlap), overlap, corners, s, push);
  }
  for (const auto& [key, corner] : before) lose(stored(corner), energy);  // it has left

  const PlatformSpeed platform{b.velocity[0], b.spin[0]};
  for (std::size_t i = 0; i < b.count(); ++i) {
    const Vec2 velocity = b.velocity[i];
    const double spin = b.spin[i];
    b.velocity[i] += b.inverse_mass[i] * push[i].impulse;
    b.spin[i] += b.inverse_inertia[i] * push[i].twist;
    const double work = 0.5 * dot(push[i].impulse, velocity + b.velocity[i]) + 0.5 * push[i].twist * (spin + b.spin[i]);
    energy.work += work;
    s.ledger[Channel::impact].energy += work;
  }
  drive_floes(of_substep_, s);
  move_struck_platform(of_substep_, s, platform);
  move_floes(of_substep_, s);
}

CompliantContacts::PairLaw CompliantContacts::law_of(const Rules& rules, const Bodies& b,
                                                     const Overlap& overlap) const {
  const SceneDef& scene = rules.scene;
  const bool ice = b.kind[overlap.a] == BodyKind::floe || b.kind[overlap.b] == BodyKind::floe;
  const bool structure = b.kind[overlap.a] == BodyKind::platform;
  const double thickness = crushed_thickness(b, overlap.a, overlap.b);
  const double k = corner_stiffness(scene.contact, thickness, ice);
  const double c = corner_damping(scene.contact, k, b.inverse_mass[overlap.a] + b.inverse_mass[overlap.b]);
  return {{k, c, structure ? scene.ice.friction_structure : scene.ice.friction_ice},
          {scene.ice.crushing_pressure_Pa, scene.ice.pressure_area_exponent, thickness},
          ice && scene.contact.crushing_limit};
}

/// The corners with their speeds and what they remember, which is taken out of `before`. Where a corner has entered, or
/// presses another side than before, its spring has changed by its motion in this substep alone.
std::vector<CompliantContacts::Corner> CompliantContacts::recall(const Bodies& b, const Overlap& overlap,
                                                                 Memory& before) const {
  std::vector<Corner> corners;
  for (const CornerInside& at : overlap.corners) {
    Corner c;
    c.at = at;
    c.key = contact_key(overlap.a, overlap.b, 2 * at.corner + (at.p == overlap.b ? 1 : 0));
    const Vec2 u = velocity_at(b, at.p, at.place) - velocity_at(b, at.q, at.place);
    c.u_n = dot(u, at.normal);
    c.u_t = dot(u, turned_left(at.normal));
    const auto found = before.find(c.key);
    c.fresh = found == before.end();
    if (!c.fresh) {
      c.memory = found->second;
      before.erase(found);
    }
    if (c.memory.pressed_side != at.side)
      c.memory.crushed = std::max(0.0, at.depth - std::max(0.0, c.memory.elastic - h_ * c.u_n));
    c.memory.pressed_side = at.side;
    corners.push_back(c);
  }
  return corners;
}

/// Where a loaded corner of the pair has left, a corner that meets fresh ice in this substep goes on with its spring.
void CompliantContacts::hand_over(const Overlap& overlap, std::vector<Corner>& corners, Memory& before,
                                  ContactEnergy& energy) const {
  const auto end = before.lower_bound(contact_key(overlap.a, overlap.b + 1, 0));
  auto left = end;
  for (auto at = before.lower_bound(contact_key(overlap.a, overlap.b, 0)); at != end; ++at)
    if (at->second.normal > (left == end ? 0.0 : left->second.normal)) left = at;
  if (left == end) return;
  const auto fresh = std::find_if(corners.begin(), corners.end(), [](const Corner& c) { return c.fresh; });
  if (fresh == corners.end()) return;
  CornerMemory& m = fresh->memory;
  m = left->second;
  m.pressed_side = fresh->at.side;
  m.elastic = std::min(m.elastic, fresh->at.depth);
  m.crushed = fresh->at.depth - m.elastic;
  lose(stored(left->second) - stored(m), energy);
  before.erase(left);
}

/// The forces of one pair. Every corner has its force from the velocities before all of them.
void CompliantContacts::press(const PairLaw& law, const Overlap& overlap, std::vector<Corner>& corners, State& s,
                              std::vector<Push>& push) {
  double trial = 0.0, depth = 0.0;
  for (Corner& c : corners) {
    c.trial = corner_pressure(law.corner, c.at.depth - c.memory.crushed, c.u_n);
    trial += c.trial;
    depth = std::max(depth, c.at.depth);
  }
  const double bound = crushing_force(law.ice, overlap.chord);
  const bool crushes = law.crushes && trial > bound;
  PairSum& sum = pairs_[{overlap.a, overlap.b}];
  sum.friction = law.corner.friction;
  for (Corner& c : corners) {
    load(law.corner, crushes ? bound / trial * c.trial : c.trial, crushes, c, s.ledger);
    give(c, c.at.p == overlap.b, sum, s, push);
    memory_[c.key] = c.memory;
  }
  const double force = crushes ? bound : trial;
  if (!(force > sum.largest_force)) return;
  sum.largest_force = force;
  sum.chord = overlap.chord;
  sum.growth = corners.size() == 1 ? overlap.chord / depth : 0.0;
}

/// A corner under the force `force`, which crushing has bound if `crushes`. Books what it loses since the last force:
/// the means of both forces times the motion between them.
void CompliantContacts::load(const CornerLaw& law, double force, bool crushes, Corner& c, Ledger& ledger) const {
  const CornerMemory before = c.memory;
  const double closed = -h_ * c.u_n, slid = h_ * c.u_t, k = law.stiffness;  // in this substep's motion [m]
  CornerMemory& m = c.memory;
  m.normal = force;
  m.stiffness = k;
  if (crushes) m.crushed = crushed_depth(law, m.crushed, c.at.depth, force);
  m.elastic = std::max(0.0, c.at.depth - m.crushed);
  m.stretch = corner_stretch(law, m.stretch, slid, force);
  m.side = corner_friction(law, m.stretch, c.u_t, force);

  const double spring = 0.5 * k * (before.elastic + m.elastic), pull = 0.5 * k * (before.stretch + m.stretch);
  const double rubbed = -0.5 * (before.side + m.side) * slid - pull * (m.stretch - before.stretch);
  ledger.contact.load += h_ * force;
  ledger.contact.crushed += spring * (m.crushed - before.crushed);
  ledger.contact.damped += (0.5 * (before.normal + m.normal) - spring) * closed;
  ledger.contact.friction += rubbed;
  ledger.contact.stored += stored(m) - stored(before);
  // `impact` gets the whole work of the forces elsewhere
  ledger[Channel::impact].energy += rubbed;
  ledger[Channel::friction].energy -= rubbed;
}

/// The impulses of a corner on both bodies, and their sums.
void CompliantContacts::give(const Corner& c, bool of_b, PairSum& sum, State& s, std::vector<Push>& push) const {
  const CornerInside& at = c.at;
  const Vec2 normal = h_ * c.memory.normal * at.normal, tangential = h_ * c.memory.side * turned_left(at.normal);
  const Vec2 on_p = normal + tangential;
  push[at.p].impulse += on_p;
  push[at.p].twist += cross(at.place - s.bodies.position[at.p], on_p);
  push[at.q].impulse -= on_p;
  push[at.q].twist -= cross(at.place - s.bodies.position[at.q], on_p);
  book_ground(s, at, normal, tangential);

  const double sign = of_b ? 1.0 : -1.0, pressed = h_ * c.memory.normal;
  sum.impulse += sign * on_p;
  sum.normal_part += sign * normal;
  sum.moment += sign * cross(at.place, on_p);
  sum.pressed += pressed;
  sum.place += pressed * at.place;
  sum.deepest = std::max(sum.deepest, at.depth);
  sum.most_elastic = std::max(sum.most_elastic, c.memory.elastic);
  sum.corners.insert(c.key);
}

/// The pairs that pressed. Their point is on the line of action of their impulse.
std::vector<Touch> CompliantContacts::touches(const Bodies& start) const {
  std::vector<Touch> found;
  for (const auto& [pair, sum] : pairs_) {
    if (!(sum.pressed > 0.0) || !(length(sum.normal_part) > 0.0)) continue;
    Touch touch;
    touch.a = pair.first;
    touch.b = pair.second;
    touch.normal = (1.0 / length(sum.normal_part)) * sum.normal_part;
    touch.width = sum.chord;
    touch.growth = sum.growth;
    touch.friction = sum.friction;
    touch.largest_force = sum.largest_force;
    const Vec2 middle = (1.0 / sum.pressed) * sum.place;
    const double aside = (sum.moment - cross(middle, sum.impulse)) / dot(sum.impulse, sum.impulse);
    const Vec2 place = middle + aside * turned_right(sum.impulse);
    TouchPoint point;
    point.arm_a = place - start.position[touch.a];
    point.arm_b = place - start.position[touch.b];
    point.separation = -sum.deepest;
    point.impulse = {dot(sum.impulse, touch.normal), dot(sum.impulse, turned_left(touch.normal))};
    const Vec2 u = relative_velocity(start, touch, point);
    point.normal_before = dot(u, touch.normal);
    point.tangential_before = dot(u, turned_left(touch.normal));
    touch.points.push_back(point);
    found.push_back(touch);
  }
  return found;
}

}  // namespace gem::reference
