// One time step:
//   solo events        by gem: current drag on every floe, first half of the platform's own motion
//   contacts, motion   by Box2D's step from the current velocities: finds and solves contacts, moves, corrects overlaps
//   books              energy as the change over the step, momentum of fixed bodies from the contact impulses
//   platform           by gem: second half of the platform's own motion, in double
#include "baseline_box2d/box2d_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "baseline_box2d/body_of.h"
#include "baseline_box2d/platform_record.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/engine/step/books.h"
#include "gem/engine/step/solo_stages.h"
#include "gem/scene/checks/limit_text.h"
#include "gem/scene/scene_bounds.h"
#include "gem/scene/scene_drive.h"

namespace gem::baseline {
namespace {

double work_on(const Bodies& b, std::size_t i, Vec2 velocity, double spin) {
  return 0.5 * b.mass[i] * dot(velocity - b.velocity[i], velocity + b.velocity[i]) +
         0.5 * b.inertia[i] * (spin - b.spin[i]) * (spin + b.spin[i]);
}

/// Box2D sees a contact once the skins overlap, gem's solver before that; so the longest time step is shorter here.
void check_time_step(const SceneDef& scene) {
  const double longest = longest_unseen_step(scene, 0.0);
  if (scene.numerics.time_step_s <= longest) return;
  throw Error(ExitCode::scene_rejected,
              "numerics.time_step_s: the time step is too long for box2d (value " +
                  number_text(scene.numerics.time_step_s, 9) + ", allowed at most " + limit_text(longest) +
                  " s: bodies closing at " + number_text(closing_speed_bound(scene), 4) +
                  " m/s would overlap by more than a tenth of " + number_text(smallest_floe_width(scene), 4) +
                  " m before it sees their contact); give a smaller time step");
}

}  // namespace

Box2dEngine::Box2dEngine(const SceneDef& scene, Bodies bodies, const Box2dOptions& options)
    : options_(options), touches_(field_, options_) {
  check_solver(scene.contact.solver, {ContactSolver::independent, ContactSolver::coupled}, "box2d");
  check_one_piece(bodies, "box2d");
  check_time_step(scene);
  mooring_ = mooring_tables(scene.mooring.law, scene.mooring_design);
  dp_ = dp_law_of(scene, bodies);
  const StepConstants constants = step_constants(scene, bodies, mooring_.view(), &dp_);
  field_ = make_field_state(std::move(bodies), constants);
  drives_ = drive_schedule(scene);
  make_world();
  ledger_.start = total(field_);
}

std::string Box2dEngine::method() const {
  // version 2.4.1 reports 2.4.0, so the last number is left out
  return "box2d " + std::to_string(b2_version.major) + "." + std::to_string(b2_version.minor) + ", " +
         std::to_string(options_.velocity_iterations) + " velocity and " +
         std::to_string(options_.position_iterations) + " position iterations, skin " + number_text(options_.skin_m) +
         " m" + experiments();
}

/// The settings changed by --experiment.
std::string Box2dEngine::experiments() const {
  std::string text;
  if (options_.substeps != 1) text += ", " + std::to_string(options_.substeps) + " substeps";
  if (!options_.warm_starting) text += ", cold starts";
  if (options_.continuous) text += ", continuous";
  if (options_.mixes_friction) text += ", mixed friction";
  if (options_.restitution_threshold_m_per_s != 0.0)
    text += ", restitution threshold " + number_text(options_.restitution_threshold_m_per_s) + " m/s";
  return text;
}

void Box2dEngine::make_world() {
  Bodies& b = field_.bodies;
  world_ = std::make_unique<b2World>(b2Vec2_zero);
  world_->SetAllowSleeping(false);
  world_->SetWarmStarting(options_.warm_starting);
  world_->SetContinuousPhysics(options_.continuous);
  world_->SetSubStepping(false);
  world_->SetContactListener(&touches_);
  body_.clear();
  for (std::size_t i = 0; i < b.count(); ++i)
    body_.push_back(add_body(*world_, b, i, options_.skin_m, options_.continuous));
  for (std::size_t i = 0; i < b.count(); ++i)
    if (body_[i] != nullptr && b.kind[i] == BodyKind::floe) b.position[i] = from_box2d(body_[i]->GetWorldCenter());
  platform_angle_ = std::atan2(b.rotation[0].sine, b.rotation[0].cosine);
  outline_made_.assign(b.count(), step_);
}

void Box2dEngine::advance(std::int64_t steps, StepLog& log) {
  check_finite(field_, step_);
  for (std::int64_t m = 0; m < steps; ++m) one_step(log);
}

void Box2dEngine::one_step(StepLog& log) {
  FieldState& f = field_;
  f.drive = drives_.at(step_);
  const PlatformImpulses before = platform_impulses(f);
  for (std::size_t i = 0; i < f.bodies.count(); ++i)
    if (f.bodies.kind[i] == BodyKind::floe) kick_floe(f, i);
  platform_first_half(f);

  give_velocities();
  touches_.clear();
  for (int k = 0; k < options_.substeps; ++k) {
    world_->Step(static_cast<float>(f.constants.dt / options_.substeps), options_.velocity_iterations,
                 options_.position_iterations);
    touches_.read_impulses();
  }
  touches_.sort();

  StepQuality quality = this->quality();
  PlatformStep row = ice_row(f, touches_.touches());
  if (log.wants_events) log_events(f, touches_.touches(), static_cast<double>(step_) * f.constants.dt, log.events);
  book_fixed_bodies();
  place_ = f.bodies.position;
  for (std::size_t i = 0; i < f.bodies.count(); ++i)
    if (f.bodies.kind[i] == BodyKind::floe && f.bodies.active[i]) take_floe(i);
  take_platform();
  if (options_.measures_quality) quality.residual = closing_speed_left();
  platform_second_half(f);
  ++step_;
  check_finite(f, step_);
  retire(f);
  disable_retired();

  row.position = f.bodies.position[0];
  row.rotation = f.bodies.rotation[0];
  row.velocity = f.bodies.velocity[0];
  row.spin = f.bodies.spin[0];
  row.broken = f.broken;
  const PlatformImpulses after = platform_impulses(f);
  row.mooring_impulse = after.mooring - before.mooring;
  row.drag_impulse = after.drag - before.drag;
  log.platform.push_back(row);
  if (f.constants.events.dp) log.dp.push_back(f.dp);
  log.quality.push_back(quality);
}

void Box2dEngine::give_velocities() {
  const Bodies& b = field_.bodies;
  for (std::size_t i = 0; i < b.count(); ++i) {
    if (body_[i] == nullptr || !b.active[i] || b.kind[i] == BodyKind::fixed) continue;
    body_[i]->SetLinearVelocity(to_box2d(b.velocity[i]));
    body_[i]->SetAngularVelocity(static_cast<float>(b.spin[i]));
  }
  if (body_[0] != nullptr)
    body_[0]->SetTransform(to_box2d(field_.platform_position), static_cast<float>(platform_angle_));
}

void Box2dEngine::refresh_outline(std::int32_t i) {
  if (outline_made_[i] == step_) return;
  turn_outline(field_, i);
  outline_made_[i] = step_;
}

StepQuality Box2dEngine::quality() {
  StepQuality quality;
  quality.contacts = touches_.points();
  quality.iterations = options_.velocity_iterations;
  quality.residual = quality.maximum_overlap = quality.maximum_share = std::nan("");
  for (const Touch& touch : touches_.touches()) {
    if (touch.a != 0) break;
    refresh_outline(touch.b);
  }
  if (!options_.measures_quality) return quality;
  const Bodies& b = field_.bodies;
  quality.maximum_overlap = 0.0;
  for (const TouchingPair& pair : touches_.pairs()) {
    refresh_outline(pair.a);
    refresh_outline(pair.b);
    const Vec2 offset = b.position[pair.b] - (pair.a == 0 ? field_.platform_position : b.position[pair.a]);
    const double apart = find_axes(field_.outline(pair.a), field_.outline(pair.b), offset).first.distance;
    quality.maximum_overlap = std::max(quality.maximum_overlap, -apart);
  }
  return quality;
}

/// Largest closing speed left at a contact point, with the lever arms of the start of the step.
double Box2dEngine::closing_speed_left() const {
  const Bodies& b = field_.bodies;
  double fastest = 0.0;
  for (const Touch& touch : touches_.touches())
    for (int k = 0; k < touch.count; ++k) {
      const Vec2 slip = b.velocity[touch.b] + cross(b.spin[touch.b], touch.point[k] - place_[touch.b]) -
                        b.velocity[touch.a] - cross(b.spin[touch.a], touch.point[k] - place_[touch.a]);
      fastest = std::max(fastest, -dot(slip, touch.normal));
    }
  return fastest;
}

void Box2dEngine::book_fixed_bodies() {
  const Bodies& b = field_.bodies;
  for (const Touch& touch : touches_.touches()) {
    const bool fixed_b = b.kind[touch.b] == BodyKind::fixed;
    if (!fixed_b && b.kind[touch.a] != BodyKind::fixed) continue;
    const double given = fixed_b ? -1.0 : 1.0;
    for (int k = 0; k < touch.count; ++k) {
      const auto enter = [&](Channel channel, Vec2 impulse) {
        field_.book(channel, 0).momentum += given * impulse;
        field_.book(channel, 0).angular_momentum += given * cross(touch.point[k], impulse);
      };
      enter(Channel::impact, touch.normal_impulse[k] * touch.normal);
      enter(Channel::friction, touch.tangent_impulse[k] * turned_left(touch.normal));
    }
  }
}

void Box2dEngine::take_floe(std::size_t i) {
  Bodies& b = field_.bodies;
  const b2Vec2 sent = to_box2d(b.velocity[i]), now = body_[i]->GetLinearVelocity();
  const float sent_spin = static_cast<float>(b.spin[i]), spin_now = body_[i]->GetAngularVelocity();
  const Vec2 place = from_box2d(body_[i]->GetWorldCenter());
  if (now != sent || spin_now != sent_spin) {
    const Vec2 velocity = b.velocity[i] + (from_box2d(now) - from_box2d(sent));
    const double spin = b.spin[i] + (static_cast<double>(spin_now) - static_cast<double>(sent_spin));
    field_.book(Channel::impact, i).energy += work_on(b, i, velocity, spin);
    const Vec2 pushed = place - b.position[i] - field_.constants.dt * velocity;
    field_.book(Channel::repair, i).angular_momentum += b.mass[i] * cross(pushed, velocity);
    b.velocity[i] = velocity;
    b.spin[i] = spin;
  }
  b.position[i] = place;
  const b2Rot& turn = body_[i]->GetTransform().q;
  b.rotation[i] = {static_cast<double>(turn.c), static_cast<double>(turn.s)};
}

void Box2dEngine::take_platform() {
  if (body_[0] == nullptr) return;
  Bodies& b = field_.bodies;
  const double dt = field_.constants.dt;
  const PlatformImpulse felt = platform_impulse(field_, touches_.touches());
  const Vec2 velocity = b.velocity[0] + b.inverse_mass[0] * felt.impulse;
  const double spin = b.spin[0] + b.inverse_inertia[0] * felt.yaw;
  field_.book(Channel::impact, 0).energy += work_on(b, 0, velocity, spin);
  if (b.inverse_inertia[0] == 0.0) field_.mooring_force.angular_momentum -= felt.yaw;
  if (b.inverse_mass[0] == 0.0) field_.held_impulse = -felt.impulse;
  b.velocity[0] = velocity;
  b.spin[0] = spin;

  // motion beyond the body's own velocity is position correction, if it is more than rounding
  const Vec2 start = from_box2d(to_box2d(field_.platform_position)), now = from_box2d(body_[0]->GetWorldCenter());
  const Vec2 pushed = now - start - dt * from_box2d(body_[0]->GetLinearVelocity());
  if (length(pushed) > 2.0 * static_cast<double>(b2_epsilon) * (length(now) + length(start)))
    field_.repair_shift[0] = pushed;
  const double turned = static_cast<double>(body_[0]->GetAngle()) -
                        static_cast<double>(static_cast<float>(platform_angle_)) -
                        dt * static_cast<double>(body_[0]->GetAngularVelocity());
  if (std::fabs(turned) > 4.0 * static_cast<double>(b2_epsilon) * (1.0 + std::fabs(platform_angle_)))
    field_.repair_turn[0] = turned;
  platform_angle_ += dt * spin + field_.repair_turn[0];
}

void Box2dEngine::disable_retired() {
  for (std::size_t i = 0; i < body_.size(); ++i)
    if (body_[i] != nullptr && !field_.bodies.active[i] && body_[i]->IsEnabled()) body_[i]->SetEnabled(false);
}

Ledger Box2dEngine::ledger() { return closed_books(field_, ledger_); }

EngineState Box2dEngine::save() {
  return {step_, field_.bodies, saved_books(field_, ledger_), {}, {}, {}, field_.broken, field_.dp};
}

void Box2dEngine::restore(const EngineState& state) {
  field_ = make_field_state(state.bodies, field_.constants);
  open_books(field_, state);
  ledger_ = state.ledger;
  step_ = state.step;
  make_world();
}

}  // namespace gem::baseline
