// Uses one problem (contact_problem.h) three times: for a single pair, for all pairs, and for their position repair.
#include "gem/engine/reference/reference_contacts.h"

#include <algorithm>
#include <cmath>

#include "gem/engine/reference/contact_problem.h"
#include "gem/engine/reference/reference_books.h"
#include "gem/events/crushing.h"
#include "gem/events/elastic_contact.h"
#include "gem/events/mass_reduction.h"

namespace gem::reference {
namespace {

ContactCompliance compliance_of(const Bodies& b, const Touch& touch, const TouchPoint& p) {
  return contact_compliance(mass_of(b, touch.a), p.arm_a, mass_of(b, touch.b), p.arm_b, touch.normal);
}

CrushingIce ice_of(const Rules& rules, const Bodies& b, const Touch& touch) {
  return {rules.scene.ice.crushing_pressure_Pa, rules.scene.ice.pressure_area_exponent,
          crushed_thickness(b, touch.a, touch.b)};
}

/// Independent: separating speed that the elastic stress asks for, limited by crushing [m/s].
double elastic_target(const Rules& rules, const Bodies& b, const Touch& touch, const TouchPoint& p) {
  const double stiffness = rules.scene.contact.elastic_stiffness_N_per_m;
  if (!(stiffness > 0.0 && p.separation < 0.0)) return 0.0;
  const double k = compliance_of(b, touch, p).nn;
  return std::min(elastic_separating_speed(stiffness, -p.separation, 1.0 / k, rules.dt),
                  crushing_force(ice_of(rules, b, touch), touch.width) * rules.dt * k);
}

/// Coupled: normal impulse of one point that crushes the smaller body across its whole size [N s].
double crushing_cap(const Rules& rules, const Bodies& b, const Touch& touch) {
  const bool ice = b.kind[touch.a] == BodyKind::floe || b.kind[touch.b] == BodyKind::floe;
  if (!rules.scene.contact.crushing_limit || !ice) return std::numeric_limits<double>::infinity();
  const double width = std::sqrt(std::min(b.area[touch.a], b.area[touch.b]));
  return crushing_force(ice_of(rules, b, touch), width) * rules.dt / static_cast<double>(touch.points.size());
}

/// Coupled: shift along the normal that removes a share of the overlap [m].
double repair_target(const Rules& rules, const TouchPoint& p) {
  const NumericsDef& n = rules.scene.numerics;
  if (!(p.separation < 0.0)) return 0.0;
  return std::min(-n.repair_share * p.separation, n.repair_speed_m_per_s * rules.dt);
}

std::vector<ProblemPoint> problem_points(const Bodies& b, const std::vector<Touch>& touches) {
  std::vector<ProblemPoint> points;
  for (const Touch& touch : touches)
    for (const TouchPoint& p : touch.points)
      points.push_back({owner_of(b, touch.a), touch.b, touch.normal, p.arm_a, p.arm_b, p.target, p.cap, touch.friction,
                        p.spare, p.last, p.rise});
  return points;
}

std::vector<ProblemBody> problem_bodies(const Bodies& b) {
  std::vector<ProblemBody> bodies;
  for (std::size_t i = 0; i < b.count(); ++i)
    bodies.push_back({mass_of(b, static_cast<std::int32_t>(i)), b.velocity[i], b.spin[i]});
  return bodies;
}

/// Independent, one point: the impact law gives the impulse.
ContactImpulse impulse_of(const Rules& rules, const Bodies& b, const Touch& touch, const TouchPoint& p) {
  const ContactCompliance k = compliance_of(b, touch, p);
  const double u_n = p.normal_before, u_t = p.tangential_before;
  if (!(touch.friction > 0.0)) return {impact_frictionless(k.nn, u_n, p.target), 0.0};
  if (rules.scene.contact.friction_law == FrictionLaw::fixed_direction)
    return impact_fixed_direction(k, u_n, u_t, p.target, touch.friction);
  return impact_one_step(k, u_n, u_t, p.target, touch.friction);
}

/// Independent, two points of one pair are one event.
void resolve_two_points(const Rules& rules, const Bodies& b, const std::vector<ProblemBody>& bodies, Touch& touch) {
  std::vector<ProblemPoint> points = problem_points(b, {touch});
  // the problem contains only this pair: bodies 0 and 1
  const std::vector<ProblemBody> pair{bodies[touch.a], bodies[touch.b]};
  for (ProblemPoint& point : points) {
    point.a = 0;
    point.b = 1;
  }
  const ContactSolution solution = solve_contacts(points, pair, rules.scene.contact.friction_law);
  for (std::size_t k = 0; k < points.size(); ++k) touch.points[k].impulse = solution.impulse[k];
}

/// Coupled: the smallest shifts that remove a share of every overlap and close no gap. There is no cap: an overlap from
/// crushing is also repaired, since the outlines do not change.
void find_repair(const Rules& rules, State& s, std::vector<Touch>& touches) {
  std::vector<ProblemPoint> points = problem_points(s.bodies, touches);
  std::size_t at = 0;
  for (const Touch& touch : touches)
    for (const TouchPoint& p : touch.points) {
      points[at].target = repair_target(rules, p);
      points[at].cap = std::numeric_limits<double>::infinity();
      points[at++].friction = 0.0;
    }
  std::vector<ProblemBody> at_rest = problem_bodies(s.bodies);
  for (ProblemBody& body : at_rest) body = {body.mass, {}, 0.0};
  const ContactSolution solution = solve_contacts(points, at_rest, FrictionLaw::one_step, Infeasible::regularise);
  at = 0;
  for (Touch& touch : touches)
    for (TouchPoint& p : touch.points) {
      p.repair = solution.impulse[at++].normal;
      const Vec2 push = p.repair * touch.normal;
      s.repair_shift[touch.b] += s.bodies.inverse_mass[touch.b] * push;
      s.repair_turn[touch.b] += s.bodies.inverse_inertia[touch.b] * cross(p.arm_b, push);
      const std::int32_t a = owner_of(s.bodies, touch.a);
      s.repair_shift[a] -= s.bodies.inverse_mass[a] * push;
      s.repair_turn[a] -= s.bodies.inverse_inertia[a] * cross(p.arm_a, push);
    }
}

/// Limits the repair: no point of a body moves farther than repair_reach in one time step. The rest waits.
void bound_repair(const Rules& rules, State& s) {
  for (std::size_t i = 0; i < s.bodies.count(); ++i) {
    const double farthest = length(s.repair_shift[i]) + s.bodies.radius[i] * std::fabs(s.repair_turn[i]);
    if (!(farthest > rules.repair_reach)) continue;
    const double share = rules.repair_reach / farthest;
    s.repair_shift[i] = share * s.repair_shift[i];
    s.repair_turn[i] *= share;
  }
}

}  // namespace

void prepare_touches(const Rules& rules, const State& s, std::vector<Touch>& touches) {
  const Bodies& b = s.bodies;
  const Vec2 platform_shift = b.position[0] - s.platform_start;
  for (Touch& touch : touches) {
    const bool on_platform = b.kind[touch.a] == BodyKind::platform;
    touch.friction = on_platform ? rules.scene.ice.friction_structure : rules.scene.ice.friction_ice;
    for (TouchPoint& p : touch.points) {
      // the platform has moved since the contact was found, the point has not
      if (on_platform) p.arm_a -= platform_shift;
      const Vec2 velocity = relative_velocity(b, touch, p);
      p.normal_before = dot(velocity, touch.normal);
      p.tangential_before = dot(velocity, turned_left(touch.normal));
      if (rules.coupled()) {
        p.target = p.separation > 0.0 ? -p.separation / rules.dt : 0.0;  // a gap may close but not overlap
        p.cap = crushing_cap(rules, b, touch);
        p.spare =
            spare_friction(touch.friction, p.last, p.rise, compliance_of(b, touch, p), p.target - p.normal_before);
      } else {
        p.target = elastic_target(rules, b, touch, p);
      }
    }
  }
}

void resolve_alone(const Rules& rules, const State& s, std::vector<Touch>& touches) {
  const std::vector<ProblemBody> bodies = problem_bodies(s.bodies);
  for (Touch& touch : touches) {
    if (touch.points.size() == 1)
      touch.points[0].impulse = impulse_of(rules, s.bodies, touch, touch.points[0]);
    else
      resolve_two_points(rules, s.bodies, bodies, touch);
    for (TouchPoint& p : touch.points) {
      const double asked = p.target + std::max(-p.normal_before, 0.0);
      if (p.target > 0.0 && asked > 0.0) p.elastic = p.impulse.normal * (p.target / asked);
    }
  }
}

void resolve_together(const Rules& rules, State& s, std::vector<Touch>& touches, StepQuality& quality) {
  const ContactSolution solution =
      solve_contacts(problem_points(s.bodies, touches), problem_bodies(s.bodies), rules.scene.contact.friction_law);
  quality.residual = solution.residual;
  quality.iterations = solution.steps;
  std::size_t at = 0;
  for (Touch& touch : touches)
    for (TouchPoint& p : touch.points) p.impulse = solution.impulse[at++];
  find_repair(rules, s, touches);
  bound_repair(rules, s);
}

void apply_impulses(const Rules& rules, State& s, const std::vector<Touch>& touches) {
  Bodies& b = s.bodies;
  for (const Touch& touch : touches)
    for (const TouchPoint& p : touch.points) {
      // coupled: contact within reach counts, whatever impulse it carries
      if (rules.coupled() || p.acted()) s.struck[touch.a] = s.struck[touch.b] = 1;
      const Vec2 impulse = world_impulse(touch, p);
      b.velocity[touch.b] += b.inverse_mass[touch.b] * impulse;
      b.spin[touch.b] += b.inverse_inertia[touch.b] * cross(p.arm_b, impulse);
      const std::int32_t a = owner_of(b, touch.a);
      b.velocity[a] -= b.inverse_mass[a] * impulse;
      b.spin[a] -= b.inverse_inertia[a] * cross(p.arm_a, impulse);
    }
  s.carry_pieces();
}

}  // namespace gem::reference
