// Time steps cut into short ones: the contacts are found once, their gaps followed by the motion of their bodies.
#include <algorithm>
#include <cmath>

#include "bench/solver_study/moving.h"
#include "gem/engine/step/contact_stages.h"

namespace gem::bench {
namespace {

/// Box2D v3's defaults.
constexpr double soft_hertz = 30.0, soft_damping = 10.0, push_speed = 3.0;

struct Softness {
  double bias_rate, mass_share, impulse_share;
};

/// Contacts as damped springs, never stiffer than a quarter of the rate of the short time steps.
Softness softness(double h) {
  const double omega = 2.0 * M_PI * std::min(soft_hertz, 0.25 / h);
  const double damped = 2.0 * soft_damping + h * omega, stiff = h * omega * damped;
  return {omega / damped, stiff / (1.0 + stiff), 1.0 / (1.0 + stiff)};
}

/// The contacts of one time step while its short time steps pass.
struct Followed {
  Problem problem;
  Impulses impulses;
  std::vector<double> separation;
  PointOrder order;
};

Followed follow(MovingField& field, Contacts contacts) {
  Followed now;
  now.impulses = warm_impulses(contacts, field.last, repair_memory);
  for (Contact* contact : contacts) {
    prepare_contact(field.f, *contact);
    for (int k = 0; k < contact->count; ++k) now.separation.push_back(contact->slot[k].separation);
  }
  now.problem = make_problem(field.f, contacts, now.impulses);
  now.order = colour_points(now.problem);
  return now;
}

/// Velocities before, and what each point asks for, at the gaps as they are.
void renew(const MovingField& field, Followed& now) {
  const StepConstants& c = field.f.constants;
  now.problem.velocity = field.f.bodies.velocity;
  now.problem.spin = field.f.bodies.spin;
  for (std::size_t k = 0; k < now.separation.size(); ++k) {
    StudiedPoint& g = now.problem.point[k].own;
    const double gap = now.separation[k];
    g.target = gap > 0.0 ? -gap / c.dt : 0.0;
    g.repair_target = gap < 0.0 ? std::min(-c.repair_share * gap, c.repair_speed * c.dt) : 0.0;
  }
}

/// Moves the bodies and the gaps with them.
void drift(MovingField& field, Followed& now) {
  FieldState& f = field.f;
  const double h = f.constants.dt;
  const auto position = f.bodies.position;
  std::vector<double> turn = f.repair_turn;
  for (std::size_t i = 0; i < turn.size(); ++i) turn[i] += h * f.bodies.spin[i];
  // the platform's first half is behind it already
  const Vec2 first_half = f.bodies.position[0] - f.platform_position;
  field.drift();
  for (std::size_t k = 0; k < now.separation.size(); ++k) {
    const ProblemPoint& point = now.problem.point[k];
    const StudiedPoint& g = point.own;
    Vec2 apart = f.bodies.position[point.b] - position[point.b] - f.bodies.position[point.a] + position[point.a];
    if (point.a == 0) apart -= first_half;
    now.separation[k] +=
        apart.x * g.normal_x + apart.y * g.normal_y + turn[point.b] * g.lever_b_n - turn[point.a] * g.lever_a_n;
  }
}

/// A pass of Gauss-Seidel; `soft`: with the springs, else rigid. `repairs`: with the shifts that take overlap back.
void sweep(Followed& now, Motions& motions, const Softness* soft, bool repairs) {
  const Problem& problem = now.problem;
  for (const std::int32_t k : now.order.point) {
    const ProblemPoint& point = problem.point[k];
    StudiedPoint g = point.own;
    const PointImpulse<double> before = now.impulses[k];
    if (!repairs) g.repair_target = -1.0;
    if (soft != nullptr && now.separation[k] <= 0.0) {
      // the springs' impulse -m' (u_n + bias) - s P as a plain visit with another compliance and target
      g.inverse_nn *= soft->mass_share;
      g.target = std::min(-soft->bias_rate * now.separation[k], push_speed) -
                 soft->impulse_share * before.normal / g.inverse_nn;
    }
    PointImpulse<double> next = before, carried = before;
    visit_studied<PointFriction::coulomb>(g, motions[point.a], motions[point.b], problem.dt, 1.0 / problem.dt, 0.0,
                                          next, carried);
    now.impulses[k] = next;
    add_change(problem, point,
               {next.normal - before.normal, next.tangential - before.tangential, next.repair - before.repair},
               motions);
  }
}

/// Runs `one_step` through the short time steps with their own constants.
template <class OneStep>
void through_steps(MovingField& field, const StepConstants& small, int steps, OneStep&& one_step) {
  const StepConstants whole = field.f.constants;
  const Contacts contacts = field.find();
  field.f.constants = small;
  if (field.score.steps == 1)  // the leader's impulses are those of a whole time step
    for (auto& [key, impulse] : field.last) impulse = {impulse.normal / steps, impulse.tangential / steps, 0.0};
  field.kick();
  Followed now = follow(field, contacts);
  for (int step = 0; step < steps; ++step) {
    if (step > 0) field.kick();
    renew(field, now);
    one_step(now);
  }
  field.last = remembered(contacts, now.impulses);
  field.f.constants = whole;
}

StepConstants constants_of_step(const SceneDef& scene, const FieldState& f, int steps) {
  SceneDef small = scene;
  small.numerics.time_step_s /= steps;
  return step_constants(small, f.bodies);
}

}  // namespace

Stepper small_steps(const SceneDef& scene, int steps) {
  return {"small steps " + std::to_string(steps), [=](MovingField& field) {
            const StepConstants small = constants_of_step(scene, field.f, steps);
            through_steps(field, small, steps, [&](Followed& now) {
              for (PointImpulse<double>& impulse : now.impulses) impulse.repair = 0.0;
              keep_best_share(now.problem, now.impulses, 1.0);
              Motions motions = motions_of(now.problem, now.impulses);
              sweep(now, motions, nullptr, true);
              field.take(now.problem, motions);
              field.note_change(now.problem.velocity, now.problem.spin);
              drift(field, now);
            });
          }};
}

Stepper soft_steps(const SceneDef& scene, int steps) {
  return {"soft steps " + std::to_string(steps), [=](MovingField& field) {
            const StepConstants small = constants_of_step(scene, field.f, steps);
            const Softness soft = softness(small.dt);
            through_steps(field, small, steps, [&](Followed& now) {
              for (PointImpulse<double>& impulse : now.impulses) impulse.repair = 0.0;
              Motions motions = motions_of(now.problem, now.impulses);
              sweep(now, motions, &soft, false);
              field.take(now.problem, motions);
              field.note_change(now.problem.velocity, now.problem.spin);
              drift(field, now);
              // relaxed: the rigid answer from here on, on top of what the drift left
              const Motions pressed = motions;
              renew(field, now);
              sweep(now, motions, nullptr, false);
              Bodies& b = field.f.bodies;
              const auto velocity = b.velocity;
              const auto spin = b.spin;
              for (std::size_t i = 0; i < b.count(); ++i) {
                b.velocity[i] += Vec2{motions[i].x - pressed[i].x, motions[i].y - pressed[i].y};
                b.spin[i] += motions[i].spin - pressed[i].spin;
              }
              field.note_change(velocity, spin);
            });
          }};
}

}  // namespace gem::bench
