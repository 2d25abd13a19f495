// What the contacts of a time step did to a body, read from its row: velocity changes, and energy and momentum for the
// books.
#pragma once

#include "gem/engine/device/workspace.h"
#include "gem/engine/step/pair_event.h"

namespace gem {

/// Books the momentum that a fixed body gave in the contact at entry `row` of body i. The fixed body may be A or B.
GEM_DEVICE inline void book_fixed_contact(const DeviceScene& s, std::int32_t i, const BodyCell& cell,
                                          std::int32_t row) {
  const bool fixed_b = cell.kind == BodyKind::fixed;
  if (!fixed_b && s.body[s.row_other[row]].kind != BodyKind::fixed) return;
  const Contact& contact = s.contact[s.row_pair[row]];
  const ContactBooks books{s.book(Channel::impact, i), s.book(Channel::elastic, i), s.book(Channel::friction, i)};
  for (int k = 0; k < contact.count; ++k)
    if (acted(contact.slot[k])) book_fixed(books, contact, contact.slot[k], cell.position, fixed_b);
}

/// Which entries in 32 entries of a row were written in this time step: a bit for each.
struct RowChanges {
  static constexpr int stretch = 32;
  std::uint32_t entries = 0, works = 0;
};

/// Entries that are loaded together to hide the latency of memory.
constexpr int loaded_together = 2;

GEM_DEVICE inline RowChanges row_changes(const DeviceScene& s, std::int32_t row, std::int32_t places,
                                         std::int32_t step) {
  constexpr int together = 8;
  RowChanges changes;
  for (int first = 0; first < RowChanges::stretch && first < places; first += together) {
    RowStamp stamp[together];
    for (int k = 0; k < together; ++k) stamp[k] = first + k < places ? s.stamp[row + first + k] : RowStamp{};
    for (int k = 0; k < together; ++k) {
      changes.entries |= stamp[k].entry == step ? 1U << (first + k) : 0U;
      changes.works |= stamp[k].work == step ? 1U << (first + k) : 0U;
    }
  }
  return changes;
}

/// Takes out the lowest set bits and holds their positions; -1 where no bit is left.
struct LowestPlaces {
  std::int32_t at[loaded_together];
  GEM_DEVICE explicit LowestPlaces(std::uint32_t& bits) {
    for (std::int32_t& place : at) {
      place = bits != 0 ? bits_in(~bits & (bits - 1U)) : -1;
      bits &= bits - 1U;
    }
  }
};

/// Copies field by field: the compiler copies whole records byte by byte.
GEM_DEVICE inline RowWork read_work(const RowWork& from) {
  RowWork work;
  for (int k = 0; k < 2; ++k) {
    work.slot[k].impact = from.slot[k].impact;
    work.slot[k].elastic = from.slot[k].elastic;
    work.slot[k].friction = from.slot[k].friction;
  }
  work.count = from.count;
  return work;
}

/// Copies field by field, as read_work().
GEM_DEVICE inline RowEntry read_entry(const RowEntry& from) {
  RowEntry entry;
  for (int k = 0; k < 2; ++k) {
    entry.velocity[k].x = from.velocity[k].x;
    entry.velocity[k].y = from.velocity[k].y;
    entry.spin[k] = from.spin[k];
  }
  entry.count = from.count;
  entry.acted = from.acted;
  return entry;
}

/// Adds the energy of the last time step's contacts at some entries of a row to the books of body B.
GEM_DEVICE inline void book_works(const DeviceScene& s, std::int32_t i, std::int32_t row, std::uint32_t places) {
  if (places == 0) return;
  double &impact = s.book(Channel::impact, i).energy, &elastic = s.book(Channel::elastic, i).energy,
         &friction = s.book(Channel::friction, i).energy;
  SlotWork sum{impact, elastic, friction};
  const auto add = [&sum](const SlotWork& took) {
    sum.impact += took.impact;
    sum.elastic += took.elastic;
    sum.friction += took.friction;
  };
  while (places != 0) {
    const LowestPlaces next(places);
    RowWork some[loaded_together];
    for (int k = 0; k < loaded_together; ++k)
      if (next.at[k] >= 0) some[k] = read_work(s.work[row + next.at[k]]);
    for (int k = 0; k < loaded_together; ++k) {
      if (next.at[k] < 0) continue;
      if (some[k].count > 0) add(some[k].slot[0]);
      if (some[k].count > 1) add(some[k].slot[1]);
    }
  }
  impact = sum.impact;
  elastic = sum.elastic;
  friction = sum.friction;
}

/// Books the work of the last time step's contacts. Entries with this `stamp` count.
GEM_DEVICE inline void add_row_work(const DeviceScene& s, std::int32_t i, const BodyMotion& motion,
                                    std::int32_t stamp) {
  for (std::int32_t first = 0; first < motion.lower_count; first += RowChanges::stretch) {
    const std::int32_t row = motion.row_begin + first;
    const std::uint32_t works = row_changes(s, row, motion.lower_count - first, stamp).works;
    book_works(s, i, row, works);
    for (int k = 0; k < RowChanges::stretch && works >> k != 0; ++k)
      // the books may be closed once more before the next time step: this work must not count twice
      if (works >> k & 1U) s.stamp[row + k].work = -1;
  }
}

/// Adds what a contact does to a body. Returns whether it acted.
GEM_DEVICE inline bool add_entry(const RowEntry& entry, BodyAfter& after) {
  for (int k = 0; k < 2; ++k) {
    if (k >= entry.count) break;
    after.velocity += entry.velocity[k];
    after.spin += entry.spin[k];
  }
  return entry.acted != 0;
}

/// Adds the contacts at some entries of a row in order. Returns whether any acted.
GEM_DEVICE inline bool add_entries(const DeviceScene& s, std::int32_t row, std::uint32_t places, BodyAfter& after) {
  bool struck = false;
  while (places != 0) {
    const LowestPlaces next(places);
    RowEntry some[loaded_together];
    for (int k = 0; k < loaded_together; ++k)
      if (next.at[k] >= 0) some[k] = read_entry(s.entry[row + next.at[k]]);
    for (int k = 0; k < loaded_together; ++k)
      if (next.at[k] >= 0) struck = add_entry(some[k], after) || struck;
  }
  return struck;
}

/// Adds the contacts of the time step by ascending id of the other body. Returns whether any acted. Coupled: the solver
/// has added them already, so this only writes books.
template <ContactSolver solver>
GEM_DEVICE inline bool add_row(const DeviceScene& s, std::int32_t i, const BodyCell& cell, const BodyMotion& motion,
                               std::int32_t step, BodyAfter& after) {
  const bool moves = solver == ContactSolver::independent && cell.kind == BodyKind::floe;
  const std::int32_t begin = motion.row_begin, lower = motion.lower_count;
  const std::int32_t places = moves ? motion.row_count : lower;
  bool struck = false;
  for (std::int32_t first = 0; first < places; first += RowChanges::stretch) {
    const std::int32_t row = begin + first;
    const RowChanges changes = row_changes(s, row, places - first, step);
    book_works(s, i, row, changes.works);
    if (moves) struck = add_entries(s, row, changes.entries, after) || struck;
    // the platform and fixed bodies come first in a row
    for (std::int32_t k = 0; first + k < lower && first + k < s.non_floes && k < RowChanges::stretch; ++k)
      if ((changes.entries >> k & 1U) && s.row_other[row + k] < s.non_floes) book_fixed_contact(s, i, cell, row + k);
  }
  return struck;
}

}  // namespace gem
