#include "bench/solver_study/problem.h"

#include <algorithm>
#include <cmath>

#include "gem/engine/step/contact_stages.h"

namespace gem::bench {

Problem make_problem(const FieldState& f, Contacts contacts, const Impulses& start) {
  const Bodies& b = f.bodies;
  Problem problem{f.constants.dt, {}, b.mass, b.inertia, b.inverse_mass, b.inverse_inertia, b.velocity, b.spin};
  std::vector<std::int32_t> points_of(b.count(), 0);
  for (const Contact* contact : contacts) {
    points_of[contact->a] += contact->count;
    points_of[contact->b] += contact->count;
  }
  for (const Contact* contact : contacts)
    for (int k = 0; k < contact->count; ++k) {
      const double last = start[problem.points()].normal;
      const ContactSlot& slot = contact->slot[k];
      problem.point.push_back(
          {contact->a, contact->b, point_of_contact(f, *contact, slot, 1, 1, last),
           point_of_contact(f, *contact, slot, points_of[contact->a], points_of[contact->b], last)});
    }
  return problem;
}

Impulses warm_impulses(Contacts contacts, const WarmStart& last, double repair_share) {
  Impulses impulses;
  for (const Contact* contact : contacts)
    for (int k = 0; k < contact->count; ++k) {
      const auto found = last.find(contact_key(contact->a, contact->b, contact->slot[k].feature));
      impulses.push_back(found == last.end() ? PointImpulse<double>{} : found->second);
      impulses.back().repair *= repair_share;
    }
  return impulses;
}

WarmStart remembered(Contacts contacts, const Impulses& impulses) {
  WarmStart last;
  std::size_t point = 0;
  for (const Contact* contact : contacts)
    for (int k = 0; k < contact->count; ++k)
      last[contact_key(contact->a, contact->b, contact->slot[k].feature)] = impulses[point++];
  return last;
}

Motions motions_of(const Problem& problem, const Impulses& impulses) {
  Motions motions(problem.bodies());
  for (std::size_t i = 0; i < motions.size(); ++i)
    motions[i] = {problem.velocity[i].x, problem.velocity[i].y, problem.spin[i], 0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < problem.points(); ++k) add_change(problem, problem.point[k], impulses[k], motions);
  return motions;
}

void add_change(const Problem& problem, const ProblemPoint& point, const PointImpulse<double>& change,
                Motions& motions) {
  const auto give = [&](std::int32_t body, double sign, const Push<double>& push) {
    const double by_mass = sign * problem.inverse_mass[body], by_inertia = sign * problem.inverse_inertia[body];
    Motion<double>& m = motions[body];
    m = {m.x + by_mass * push.x,
         m.y + by_mass * push.y,
         m.spin + by_inertia * push.twist,
         m.shift_x + by_mass * push.shift_x,
         m.shift_y + by_mass * push.shift_y,
         m.turn + by_inertia * push.turn};
  };
  const StudiedPoint& g = point.own;
  give(point.a, -1.0, push_of(g, change, g.lever_a_n, g.lever_a_t));
  give(point.b, 1.0, push_of(g, change, g.lever_b_n, g.lever_b_t));
}

void keep_best_share(const Problem& problem, Impulses& impulses, double limit) {
  const Motions motions = motions_of(problem, impulses);
  ImpulseWork sum{0.0, 0.0};
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!(problem.inverse_mass[i] > 0.0)) continue;
    const ImpulseWork work = work_on_body(motions[i], problem.velocity[i].x, problem.velocity[i].y, problem.spin[i],
                                          problem.mass[i], problem.inertia[i]);
    sum = {sum.given + work.given, sum.answered + work.answered};
  }
  const double share = best_share(sum);
  if (!(share < limit)) return;
  for (PointImpulse<double>& impulse : impulses) {
    impulse.normal *= share;
    impulse.tangential *= share;
  }
}

Score score_of(const Problem& problem, const Impulses& impulses) {
  const Motions motions = motions_of(problem, impulses);
  Score score;
  double squares = 0.0;
  for (std::size_t k = 0; k < problem.points(); ++k) {
    const ProblemPoint& point = problem.point[k];
    PointImpulse<double> next = impulses[k], carried = impulses[k];
    visit_studied<PointFriction::coulomb>(point.own, motions[point.a], motions[point.b], problem.dt, 1.0 / problem.dt,
                                          0.0, next, carried);
    const double normal = std::fabs(next.normal - impulses[k].normal) * point.own.nn;
    const double tangential = std::fabs(next.tangential - impulses[k].tangential) * point.own.tt;
    score.largest = std::max({score.largest, normal, tangential});
    score.largest_repair = std::max(score.largest_repair, std::fabs(next.repair - impulses[k].repair) * point.own.nn);
    squares += normal * normal + tangential * tangential;
  }
  score.rms = problem.points() > 0 ? std::sqrt(squares / static_cast<double>(problem.points())) : 0.0;
  return score;
}

}  // namespace gem::bench
