// Spells of contact counted by hand, and a two-state process with a known fraction.
#include "gem/analysis/contact_spells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

std::vector<double> lengths(std::span<const Spell> spells) {
  std::vector<double> result;
  for (const Spell& spell : spells) result.push_back(spell.length);
  return result;
}

TEST(ContactSpells, ByHand) {
  const std::vector<double> contacts = {1, 1, 0, 0, 0, 2, 1, 0, 3, 0, 0, 0, 0};
  const ContactSpells spells = contact_spells(contacts, 0.5);
  EXPECT_DOUBLE_EQ(spells.fraction, 5.0 / 13.0);
  EXPECT_EQ(lengths(spells.contact), (std::vector<double>{1.0, 1.0, 0.5}));
  EXPECT_EQ(lengths(spells.gap), (std::vector<double>{1.5, 0.5, 2.0}));
  // The first spell and the last gap are cut off by the record.
  EXPECT_FALSE(spells.contact[0].begin_seen);
  EXPECT_TRUE(spells.contact[0].end_seen);
  EXPECT_FALSE(spells.gap[2].end_seen);
  EXPECT_EQ(cut_spells(spells.contact), 1u);
  EXPECT_EQ(cut_spells(spells.gap), 1u);
  EXPECT_EQ(spell_mean(spells.contact), 2.5 / 3.0);  // three ends
  EXPECT_EQ(spell_mean(spells.gap), 4.0 / 2.0);      // two ends
  EXPECT_EQ(longest_spell(spells.gap), 2.0);
}

TEST(ContactSpells, OfARecordThatNeverChanges) {
  EXPECT_EQ(contact_spells({}, 0.1).fraction, 0.0);
  EXPECT_TRUE(contact_spells({}, 0.1).contact.empty());
  const ContactSpells spells = contact_spells(std::vector<double>(10, 1.0), 0.5);
  EXPECT_EQ(spells.fraction, 1.0);
  EXPECT_TRUE(spells.gap.empty());
  EXPECT_EQ(longest_spell(spells.contact), 5.0);
  EXPECT_EQ(cut_spells(spells.contact), 1u);
  EXPECT_FALSE(spell_mean(spells.contact).has_value());
  EXPECT_FALSE(spell_median(spells.contact).has_value());
  EXPECT_FALSE(longest_spell(spells.gap).has_value());
}

// Two contacts of half a second, then contact from 165 s to the end at 600 s.
TEST(ContactSpells, ALastSpellWithoutEndIsTheLongest) {
  std::vector<double> contacts(1200, 0.0);
  contacts[100] = contacts[200] = 1.0;
  std::fill(contacts.begin() + 330, contacts.end(), 1.0);
  const ContactSpells spells = contact_spells(contacts, 0.5);
  EXPECT_EQ(longest_spell(spells.contact), 435.0);
  EXPECT_EQ(cut_spells(spells.contact), 1u);
  EXPECT_EQ(spell_mean(spells.contact), 436.0 / 2.0);
  EXPECT_EQ(spell_median(spells.contact), 0.5);
}

// Lengths 1, 2, 3+, 4, 5+ (+ is cut): survival is 4/5, 3/5, 3/5, 3/10 after 1, 2, 3, 4.
TEST(ContactSpells, MedianOfCutSpells) {
  std::vector<Spell> spells = {{4.0}, {1.0}, {3.0, true, false}, {2.0}, {5.0, true, false}};
  EXPECT_EQ(spell_median(spells), 4.0);
  spells[0].end_seen = false;
  EXPECT_FALSE(spell_median(spells).has_value());
  // A spell that started before the record has an unknown length and is left out.
  spells.assign({{1.0}, {9.0, false, true}, {8.0, false, true}});
  EXPECT_EQ(spell_median(spells), 1.0);
}

// Exponential spells of 10 s, observed for at most 15 s: a share exp(-1.5) is cut. Without the cut spells the mean
// would be 10 - 15 / (exp(1.5) - 1) = 5.7 s. With 20000 spells the mean scatters by 0.8 %, the median by 1 %.
TEST(ContactSpells, CutSpellsDoNotBiasTheMean) {
  std::vector<Spell> spells;
  RandomSequence random = test_random(11);
  for (int i = 0; i < 20000; ++i) {
    const double length = -10.0 * std::log(1.0 - random.uniform());
    spells.push_back({std::min(length, 15.0), true, length <= 15.0});
  }
  EXPECT_NEAR(*spell_mean(spells), 10.0, 0.3);
  EXPECT_NEAR(*spell_median(spells), 10.0 * std::log(2.0), 0.3);
}

TEST(ContactSpells, AFractionOfNoneOrAllHasAnIntervalToo) {
  constexpr double z2 = 1.959963984540054 * 1.959963984540054;
  const IntervalEstimate none = contact_fraction(std::vector<double>(100, 0.0), 0.1, 1.0);
  EXPECT_EQ(none.value, 0.0);
  EXPECT_NEAR(none.high, z2 / (10.0 + z2), 1e-12) << "ten blocks, none with contact";
  const IntervalEstimate all = contact_fraction(std::vector<double>(100, 2.0), 0.1, 1.0);
  EXPECT_EQ(all.value, 1.0);
  EXPECT_NEAR(all.low, 10.0 / (10.0 + z2), 1e-12);
}

TEST(ContactSpells, AFractionStaysWithinZeroAndOne) {
  std::vector<double> contacts(100, 0.0);
  for (int i = 45; i < 55; ++i) contacts[i] = 1.0;  // in the middle, where most blocks lie
  EXPECT_LT(moving_block_mean(contacts, 10).low, 0.0);
  const IntervalEstimate few = contact_fraction(contacts, 0.1, 1.0);
  EXPECT_EQ(few.low, 0.0);
  EXPECT_GT(few.high, few.value);
  for (double& contact : contacts) contact = 1.0 - contact;
  const IntervalEstimate most = contact_fraction(contacts, 0.1, 1.0);
  EXPECT_EQ(most.high, 1.0);
  EXPECT_LT(most.low, most.value);
}

// Per sample, contact ends with probability 0.1 and begins with 0.025. So contact holds 0.2 of the time, spells last 10
// samples and gaps 40. 20000 samples have 400 spells, whose mean scatters by 5 %.
TEST(ContactSpells, OfATwoStateProcess) {
  std::vector<double> contacts(20000);
  RandomSequence random = test_random(6);
  double state = 0.0;
  for (double& value : contacts) {
    if (random.uniform() < (state > 0.0 ? 0.1 : 0.025)) state = 1.0 - state;
    value = state;
  }
  const ContactSpells spells = contact_spells(contacts, 0.1);
  EXPECT_NEAR(*spell_mean(spells.contact), 1.0, 0.15);
  const IntervalEstimate fraction = contact_fraction(contacts, 0.1, 50.0);
  EXPECT_DOUBLE_EQ(fraction.value, spells.fraction);
  EXPECT_TRUE(fraction.holds(0.2));
  EXPECT_LT(fraction.high - fraction.low, 0.08);
}

}  // namespace
}  // namespace gem
