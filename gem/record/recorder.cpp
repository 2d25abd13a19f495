// Samples at three rates: platform, floes with the books, and events when they occur.
#include "gem/record/recorder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "gem/field/floe_reserve.h"

namespace gem {

namespace {

double angle_of(Rotation q) { return std::atan2(q.sine, q.cosine); }

/// The angle of q [rad], continued from `before` over full turns.
double unwrapped(Rotation q, double before) {
  constexpr double turn = 6.283185307179586;
  const double step = angle_of(q) - before;
  return before + step - turn * std::round(step / turn);
}

std::vector<std::vector<Vec2>> platform_outlines(const Bodies& b) {
  std::vector<std::vector<Vec2>> pieces;
  for (std::size_t i = 0; i < first_fixed(b); ++i)
    pieces.emplace_back(b.vertex.begin() + b.vertex_begin[i], b.vertex.begin() + b.vertex_begin[i + 1]);
  return pieces;
}

double kinetic_energy(const Bodies& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < b.count(); ++i) {
    if (b.active[i] != 0) {
      sum += 0.5 * b.mass[i] * dot(b.velocity[i], b.velocity[i]) + 0.5 * b.inertia[i] * b.spin[i] * b.spin[i];
    }
  }
  return sum;
}

}  // namespace

std::int64_t Cadence::next_after(std::int64_t step) const {
  const double time = double(step) * time_step_;
  auto sample = static_cast<std::int64_t>(std::floor(time / interval_));
  std::int64_t next = step;
  while (next <= step) next = std::llround(double(++sample) * interval_ / time_step_);
  return next;
}

Recorder::Recorder(const SceneDef& scene, Engine& engine)
    : time_step_(scene.numerics.time_step_s),
      has_platform_(scene.platform.present),
      has_contacts_(scene.output.contact_forces),
      has_hits_(scene.output.platform_events),
      further_pieces_(platform_bodies(engine.bodies()) - 1),
      platform_(scene.output.platform_interval_s, time_step_),
      frames_(scene.output.floes_interval_s, time_step_),
      window_steps_(
          static_cast<std::size_t>(std::max<std::int64_t>(1, std::llround(scene.output.force_window_s / time_step_)))),
      hits_({scene.output.hit_release_s, scene.output.event_speed_m_per_s, scene.output.force_window_s}, time_step_),
      sides_(scene.output.side_loads && has_platform_ ? platform_outlines(engine.bodies())
                                                      : std::vector<std::vector<Vec2>>{}),
      lines_(scene),
      thrusters_(scene) {
  if (has_platform_) record_start(scene, engine.bodies());
  keep_frame(engine.bodies());
  keep_stats(engine, 0.0);
}

void Recorder::record_start(const SceneDef& scene, const Bodies& b) {
  now_.yaw = angle_of(b.rotation[0]);
  PlatformRow row;
  row.position = b.position[0];
  row.yaw = now_.yaw;
  row.velocity = b.velocity[0];
  row.spin = b.spin[0];
  slab_.platform.push_back(row);
  sides_.take(slab_.side_normal, slab_.side_friction);
  PlatformStep start;
  start.position = b.position[0];
  start.rotation = b.rotation[0];
  lines_.add(start, 0.0);
  lines_.take(slab_.line_tension, slab_.line_break_time);
  thrusters_.start(scene, start, slab_);
}

void Recorder::add(const StepLog& log, std::int64_t last_step) {
  auto row = log.events.begin();
  for (std::size_t i = 0; i < log.quality.size(); ++i) {
    ++now_.step;
    now_.worst.worsen(log.quality[i]);
    if (!has_platform_) continue;
    const PlatformStep& now = now_.last = log.platform[i];
    now_.since_sample.ice_impulse += now.ice_impulse;
    now_.since_sample.ice_yaw_impulse += now.ice_yaw_impulse;
    now_.since_sample.mooring_impulse += now.mooring_impulse;
    now_.since_sample.drag_impulse += now.drag_impulse;
    for (; row != log.events.end() && std::llround(row->time / time_step_) < now_.step; ++row)
      sides_.add(*row, now.position, now.rotation);
    lines_.add(now, double(now_.step) * time_step_);
    if (i < log.dp.size()) thrusters_.add(now, log.dp[i]);
    now_.since_sample.contacts = std::max(now_.since_sample.contacts, now.contacts);
    window_.push_back(now.ice_impulse);
    if (window_.size() > window_steps_) window_.pop_front();
    if (now_.step == platform_.next_after(now_.sample_step) || now_.step == last_step) sample(now, now_.step);
  }
  slab_.splits.insert(slab_.splits.end(), log.splits.begin(), log.splits.end());
  now_.overlap += log.overlap;
  now_.overlap_share += log.overlap_share;
  if (has_hits_) hits_.add(log.events, now_.step, slab_.events);
  slab_.time = double(now_.step) * time_step_;
}

void Recorder::keep_pieces(const StepLog& log, const Bodies& bodies) {
  for (const SplitEvent& one : log.splits)
    if (one.split.result == FloeSplit::Result::split)
      for (const std::int32_t piece : one.split.piece) slab_.pieces.add(bodies, static_cast<std::size_t>(piece));
}

void Recorder::sample_rest() {
  if (has_platform_ && now_.step > now_.sample_step) sample(now_.last, now_.step);
}

void Recorder::sample(const PlatformStep& now, std::int64_t step) {
  const double per_second = 1.0 / (double(step - now_.sample_step) * time_step_);
  Vec2 window_impulse;
  for (const Vec2& impulse : window_) window_impulse += impulse;
  now_.yaw = unwrapped(now.rotation, now_.yaw);
  PlatformRow row;
  row.time = double(step) * time_step_;
  row.position = now.position;
  row.yaw = now_.yaw;
  row.velocity = now.velocity;
  row.spin = now.spin;
  row.ice_impulse = now_.since_sample.ice_impulse;
  row.ice_force = per_second * now_.since_sample.ice_impulse;
  row.ice_force_mean = (1.0 / (double(window_.size()) * time_step_)) * window_impulse;
  row.mooring_force = per_second * now_.since_sample.mooring_impulse;
  row.drag_force = per_second * now_.since_sample.drag_impulse;
  row.ice_yaw_moment = per_second * now_.since_sample.ice_yaw_impulse;
  row.contacts = now_.since_sample.contacts;
  slab_.platform.push_back(row);
  sides_.take(slab_.side_normal, slab_.side_friction);
  lines_.take(slab_.line_tension, slab_.line_break_time);
  thrusters_.take(slab_);
  now_.since_sample = {};
  now_.sample_step = step;
}

StatsRow Recorder::add_frame(Engine& engine, double wall_time) {
  keep_frame(engine.bodies());
  keep_stats(engine, wall_time);
  if (has_contacts_) keep_contacts(engine);
  now_.frame_step = now_.step;
  now_.frame_wall_time = wall_time;
  now_.worst = {};
  now_.overlap = now_.overlap_share = {};
  return slab_.stats.back();
}

void Recorder::keep_frame(const Bodies& b) {
  FloeFrames& f = slab_.floes;
  f.time.push_back(double(now_.step) * time_step_);
  for (std::size_t i = first_floe(b); i < b.count(); ++i) {
    if (is_unborn(b, i)) {
      for (std::vector<float>* values : {&f.x, &f.y, &f.theta, &f.vx, &f.vy, &f.omega})
        values->push_back(std::numeric_limits<float>::quiet_NaN());
      f.active.push_back(0.0F);
      continue;
    }
    f.x.push_back(static_cast<float>(b.position[i].x));
    f.y.push_back(static_cast<float>(b.position[i].y));
    f.theta.push_back(static_cast<float>(angle_of(b.rotation[i])));
    f.vx.push_back(static_cast<float>(b.velocity[i].x));
    f.vy.push_back(static_cast<float>(b.velocity[i].y));
    f.omega.push_back(static_cast<float>(b.spin[i]));
    f.active.push_back(b.active[i] != 0 ? 1.0F : 0.0F);
  }
}

void Recorder::keep_contacts(Engine& engine) {
  std::vector<ContactForce> forces = engine.contact_forces();
  if (forces.size() > contacts_of_frame_maximum) {
    const auto larger = [](const ContactForce& p, const ContactForce& q) {
      return dot(p.force, p.force) > dot(q.force, q.force);
    };
    std::nth_element(forces.begin(), forces.begin() + contacts_of_frame_maximum, forces.end(), larger);
    forces.resize(contacts_of_frame_maximum);
    std::sort(forces.begin(), forces.end(),
              [](const ContactForce& p, const ContactForce& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
  }
  const double time = double(now_.step) * time_step_;
  for (const ContactForce& contact : forces) slab_.contacts.push_back({time, contact});
}

void Recorder::keep_stats(Engine& engine, double wall_time) {
  const Bodies& b = engine.bodies();
  StatsRow row;
  row.time = double(now_.step) * time_step_;
  row.ledger = engine.ledger();
  row.residual = residual(row.ledger);
  row.kinetic_energy = kinetic_energy(b);
  row.contacts = now_.worst.contacts;
  row.iterations = now_.worst.iterations;
  row.closing_residual = now_.worst.residual;
  row.maximum_overlap = now_.worst.maximum_overlap;
  row.maximum_depth = now_.worst.maximum_depth;
  row.maximum_share = now_.worst.maximum_share;
  row.complementarity = now_.worst.complementarity;
  row.cone_excess = now_.worst.cone_excess;
  row.energy_created = now_.worst.energy_created;
  row.overlap = now_.overlap;
  row.overlap_share = now_.overlap_share;
  for (std::size_t i = first_floe(b); i < b.count(); ++i) row.active_floes += b.active[i] != 0 ? 1.0 : 0.0;
  row.wall_time = wall_time;
  const double wall = wall_time - now_.frame_wall_time;
  row.sim_rate = wall > 0.0 ? double(now_.step - now_.frame_step) * time_step_ / wall : 0.0;
  row.steps = double(now_.step);
  slab_.stats.push_back(row);
}

bool Recorder::fits(const RecorderState& state) const {
  return state.sides.normal.size() == sides_.sums().normal.size() &&
         state.sides.friction.size() == sides_.sums().friction.size() &&
         state.lines.tension.size() == lines_.sums().tension.size() &&
         state.lines.break_time.size() == lines_.sums().break_time.size() &&
         state.thrusters.size() == thrusters_.sums().size();
}

void Recorder::restore(const RecorderState& state) {
  now_ = state.now;
  window_.assign(state.window.begin(), state.window.end());
  hits_.restore(state.hits);
  sides_.restore(state.sides);
  lines_.restore(state.lines);
  thrusters_.restore(state.thrusters);
  slab_ = {};
}

/// Gives the bodies in the rows the numbers of recorded_body().
void Recorder::number_as_in_files() {
  const auto number = [&](std::int32_t& body) {
    if (body >= 0) body = std::max(0, body - further_pieces_);
  };
  for (Hit& hit : slab_.events) number(hit.first.body_a), number(hit.first.body_b);
  for (ContactRow& row : slab_.contacts) number(row.contact.a), number(row.contact.b);
  for (SplitEvent& split : slab_.splits)
    for (std::int32_t* body : {&split.split.floe, &split.split.piece[0], &split.split.piece[1]}) number(*body);
}

Slab Recorder::take() {
  if (further_pieces_ > 0) number_as_in_files();
  now_.hits_taken += static_cast<std::int64_t>(slab_.events.size());
  slab_.time = double(now_.step) * time_step_;
  return std::exchange(slab_, Slab{});
}

}  // namespace gem
