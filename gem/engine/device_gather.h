// What the contacts of a moment did to a body, read from its row: velocities, energy and momentum for the books.
#pragma once

#include "gem/engine/device_desk.h"
#include "gem/engine/pair_event.h"

namespace gem {

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
GEM_DEVICE inline void gather_work(const DeviceScene& s, std::int32_t i, const BodyMotion& motion, std::int32_t stamp) {
  for (std::int32_t row = motion.row_begin; row < motion.row_begin + motion.lower_count; ++row)
    if (s.stamp[row].work == stamp) {
      book_work(s, i, s.work[row]);
      s.stamp[row].work = -1;  // the books may be closed once more before the next moment
    }
}

/// Adds what a contact does to a body; returns whether it acted.
GEM_DEVICE inline bool add_entry(const RowEntry& entry, BodyAfter& after) {
  const std::int32_t count = entry.count, acted = entry.acted;
  const Vec2 velocity = entry.step[0].velocity;
  const double spin = entry.step[0].spin;
  if (count > 0) {
    after.velocity += velocity;
    after.spin += spin;
  }
  if (count > 1) {
    after.velocity += entry.step[1].velocity;
    after.spin += entry.step[1].spin;
  }
  return acted != 0;
}

/// Adds the contacts of the moment in ascending order of the other body; returns whether any acted. Those of a coupled
/// moment are added up already.
GEM_DEVICE inline bool gather(const DeviceScene& s, std::int32_t i, const BodyCell& cell, const BodyMotion& motion,
                              std::int32_t moment, BodyAfter& after) {
  const bool moves = cell.kind == BodyKind::floe && s.constants.resolution == Resolution::independent;
  const std::int32_t begin = motion.row_begin, lower = motion.lower_count;
  const std::int32_t places = moves ? motion.row_count : lower;
  bool struck = false;
  for (std::int32_t first = 0; first < places; first += RowNews::stretch) {
    const RowNews news = row_news(s, begin + first, places - first, moment);
    for (int k = 0; (news.entries | news.works) >> k != 0; ++k) {
      const std::int32_t row = begin + first + k;
      if (news.works >> k & 1U) book_work(s, i, s.work[row]);
      if (!(news.entries >> k & 1U)) continue;
      if (moves) struck = add_entry(s.entry[row], after) || struck;
      if (first + k < lower && s.row_other[row] < s.large_bodies) book_fixed_contact(s, i, cell, row);
    }
  }
  return struck;
}

}  // namespace gem
