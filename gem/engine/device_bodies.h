// The bodies phase of a moment: each body adds what its contacts did, moves, and takes the drag of the next moment.
#pragma once

#include "gem/engine/crew.h"
#include "gem/engine/device_scene.h"
#include "gem/engine/pair_event.h"
#include "gem/engine/solo_event.h"

namespace gem {

/// One moment as its phases see it.
struct MomentStep {
  std::int32_t moment = 0;
  std::int32_t sample = 0;  // its place in the rings
  double elapsed = 0.0;     // from the building of the list to the moment's end [s]
  bool kick_next = true;    // the solo events of the next moment follow
};

GEM_DEVICE inline bool is_number(double x) { return x - x == 0.0; }

/// Energy of the last moment's contacts, into the books of their body B.
GEM_DEVICE inline void book_work(const DeviceScene& s, std::int32_t i, const RowWork& work) {
  Quantity &impact = s.book(Channel::impact, i), &elastic = s.book(Channel::elastic, i),
           &friction = s.book(Channel::friction, i);
  for (int k = 0; k < work.count; ++k) {
    impact.energy += work.slot[k].impact;
    elastic.energy += work.slot[k].elastic;
    friction.energy += work.slot[k].friction;
  }
}

/// Momentum that a fixed body gave in the contact at place `row` of body B.
GEM_DEVICE inline void book_fixed_contact(const DeviceScene& s, std::int32_t i, const BodyCell& cell,
                                          std::int32_t row) {
  const bool fixed_b = cell.kind == BodyKind::fixed;
  if (!fixed_b && s.body[s.row_other[row]].kind != BodyKind::fixed) return;
  const Contact& contact = s.contact[s.row_pair[row]];
  const ContactBooks books{s.book(Channel::impact, i), s.book(Channel::elastic, i), s.book(Channel::friction, i)};
  for (int k = 0; k < contact.count; ++k)
    if (acted(contact.slot[k])) book_fixed(books, contact, contact.slot[k], cell.position, fixed_b);
}

/// What a body's row has for it in this moment: a bit for each place of a stretch.
struct RowNews {
  static constexpr int stretch = 8;
  unsigned entries = 0, works = 0;
};

GEM_DEVICE inline RowNews row_news(const DeviceScene& s, std::int32_t row, std::int32_t places, std::int32_t moment) {
  RowStamp stamp[RowNews::stretch];
  for (int k = 0; k < RowNews::stretch; ++k) stamp[k] = k < places ? s.stamp[row + k] : RowStamp{};
  RowNews news;
  for (int k = 0; k < RowNews::stretch; ++k) {
    news.entries |= stamp[k].entry == moment ? 1U << k : 0U;
    news.works |= stamp[k].work == moment ? 1U << k : 0U;
  }
  return news;
}

/// Books the work of the last moment's contacts; `stamp` says which entries count.
GEM_DEVICE inline void gather_work(const DeviceScene& s, std::int32_t i, const BodyCell& cell, const BodyMotion& motion,
                                   std::int32_t stamp) {
  for (std::int32_t row = cell.row_begin; row < cell.row_begin + motion.lower_count; ++row)
    if (s.stamp[row].work == stamp) {
      book_work(s, i, s.work[row]);
      s.stamp[row].work = -1;  // the books may be closed once more before the next moment
    }
}

/// Adds the contacts of the moment in ascending order of the other body; returns whether any acted.
GEM_DEVICE inline bool gather(const DeviceScene& s, std::int32_t i, const BodyCell& cell, const BodyMotion& motion,
                              std::int32_t moment, Vec2& velocity, double& spin) {
  const bool moves = cell.kind == BodyKind::floe;
  const std::int32_t places = moves ? motion.row_count : motion.lower_count;
  bool struck = false;
  for (std::int32_t first = 0; first < places; first += RowNews::stretch) {
    const RowNews news = row_news(s, cell.row_begin + first, places - first, moment);
    if ((news.entries | news.works) == 0) continue;
    for (int k = 0; k < RowNews::stretch; ++k) {
      const std::int32_t at = first + k, row = cell.row_begin + at;
      if (news.works >> k & 1U) book_work(s, i, s.work[row]);
      if (!(news.entries >> k & 1U)) continue;
      const RowEntry& entry = s.entry[row];
      for (int j = 0; moves && j < entry.count; ++j) {
        velocity += entry.step[j].velocity;
        spin += entry.step[j].spin;
      }
      struck = struck || entry.acted;
      if (at < motion.lower_count && s.row_other[row] < s.large_bodies) book_fixed_contact(s, i, cell, row);
    }
  }
  return struck;
}

/// Turns a body by `angle`; its outline follows at the end of the phase.
GEM_DEVICE inline void turn(BodyCell& cell, BodyMotion& motion, double angle) {
  motion.turned = angle != 0.0;
  if (angle == 0.0) return;
  motion.rotation = turned(motion.rotation, angle);
  cell.turn_travel += angle < 0.0 ? -angle : angle;
}

/// The outlines of the block's bodies follow their rotations, a corner for each thread.
template <class Crew>
GEM_DEVICE inline void turn_outlines(const DeviceScene& s, const Crew& crew, std::int32_t first_body,
                                     std::int32_t end_body) {
  if (first_body == end_body) return;
  const BodyCell& last = s.body[end_body - 1];
  const std::int32_t end = last.vertex_begin + last.vertex_count;
  for (std::int32_t v = s.body[first_body].vertex_begin + crew.thread(); v < end; v += crew.threads()) {
    const Vec2 corner = s.vertex[v], normal = s.body_normal[v];
    const BodyMotion& motion = s.motion[s.vertex_body[v]];
    if (!motion.turned) continue;
    s.corner[v] = rotate(motion.rotation, corner);
    s.normal[v] = rotate(motion.rotation, normal);
  }
}

/// Whether a body left the course that the list relies on; `elapsed` is the time since the list was built [s].
GEM_DEVICE inline bool left_course(const DeviceScene& s, const BodyCell& cell, const BodyMotion& motion,
                                   double elapsed) {
  const Vec2 off = cell.position - motion.course_position - elapsed * motion.course_velocity;
  const double left = 0.5 * s.constants.list_margin - cell.radius * (cell.turn_travel - motion.course_turned);
  return !(left > 0.0 && dot(off, off) < left * left);
}

/// The drag of the next moment on a floe that moves with velocity_after and spin_after.
GEM_DEVICE inline void kick_body(const DeviceScene& s, std::int32_t i, BodyCell& cell, BodyMotion& motion) {
  cell.velocity = cell.velocity_after;
  cell.spin = cell.spin_after;
  if (s.constants.drag_law == DragLaw::none || !cell.active) return;
  const Kick kicked = kick(s.constants, motion.drag, motion.spin_drag, cell.velocity_after, cell.spin_after);
  book_kick(s.book(Channel::drag, i), motion.mass, motion.inertia, cell.position, cell.velocity_after, cell.spin_after,
            kicked);
  cell.velocity = kicked.velocity;
  cell.spin = kicked.spin;
  motion.path_correction = kicked.path_correction;
  motion.angle_correction = kicked.angle_correction;
}

/// Moves a floe with its velocity after the events.
GEM_DEVICE inline void drift(const DeviceScene& s, std::int32_t i, BodyCell& cell, BodyMotion& motion, bool struck) {
  const double dt = s.constants.dt;
  double angle = dt * cell.spin_after;
  if (struck) {
    cell.position += dt * cell.velocity_after + Vec2{};  // no repair: kept for the sign of a zero
  } else {
    cell.position += dt * cell.velocity_after + motion.path_correction;
    angle += motion.angle_correction;
    s.book(Channel::drag, i).angular_momentum += motion.mass * cross(motion.path_correction, cell.velocity_after);
  }
  turn(cell, motion, angle);
}

/// Retires a floe that passed the line.
GEM_DEVICE inline void retire(const DeviceScene& s, std::int32_t i, BodyCell& cell, const BodyMotion& motion) {
  if (!(cell.position.x > s.constants.retire_x)) return;
  const Quantity gone = quantity_of(motion.mass, motion.inertia, cell.position, cell.velocity_after, cell.spin_after);
  Quantity& book = s.book(Channel::retired, i);
  book.momentum -= gone.momentum;
  book.angular_momentum -= gone.angular_momentum;
  book.energy -= gone.energy;
  cell.active = 0;
}

GEM_DEVICE inline bool is_finite(const BodyCell& cell, const BodyMotion& motion, Vec2 velocity) {
  return is_number(cell.position.x + cell.position.y + velocity.x + velocity.y + cell.spin_after +
                   motion.rotation.cosine + motion.rotation.sine);
}

/// One floe or fixed body through the bodies phase.
template <class Crew>
GEM_DEVICE inline void move_body(const DeviceScene& s, Crew& crew, std::int32_t i, const MomentStep& step) {
  if (i == 0) return;  // the platform's warp moves it at the same time
  BodyCell cell = s.body[i];
  BodyMotion motion = s.motion[i];
  Vec2 velocity = cell.velocity;
  double spin = cell.spin;
  const bool struck = gather(s, i, cell, motion, step.moment, velocity, spin);
  if (cell.kind != BodyKind::floe || !cell.active) return;
  cell.velocity_after = velocity;
  cell.spin_after = spin;
  drift(s, i, cell, motion, struck);
  if (is_finite(cell, motion, velocity))
    retire(s, i, cell, motion);
  else
    crew.raise(alarm_not_finite);
  if (cell.active && left_course(s, cell, motion, step.elapsed)) crew.raise(alarm_strayed);
  if (step.kick_next) kick_body(s, i, cell, motion);
  s.body[i] = cell;
  s.motion[i] = motion;
}

}  // namespace gem
