// Spells of contact counted by hand, and a two-state process with a known fraction.
#include "gem/analysis/contact_spells.h"

#include <gtest/gtest.h>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

TEST(ContactSpells, ByHand) {
  const std::vector<double> contacts = {1, 1, 0, 0, 0, 2, 1, 0, 3, 0, 0, 0, 0};
  const ContactSpells spells = contact_spells(contacts, 0.1);
  EXPECT_DOUBLE_EQ(spells.fraction, 5.0 / 13.0);
  // The first spell and the last gap are cut off by the record.
  ASSERT_EQ(spells.contact.size(), 2u);
  ASSERT_EQ(spells.gap.size(), 2u);
  EXPECT_DOUBLE_EQ(spells.contact[0], 0.2);
  EXPECT_DOUBLE_EQ(spells.contact[1], 0.1);
  EXPECT_NEAR(spells.gap[0], 0.3, 1e-15);
  EXPECT_DOUBLE_EQ(spells.gap[1], 0.1);
}

TEST(ContactSpells, OfARecordThatNeverChanges) {
  EXPECT_EQ(contact_spells({}, 0.1).fraction, 0.0);
  const ContactSpells spells = contact_spells(std::vector<double>(10, 1.0), 0.1);
  EXPECT_EQ(spells.fraction, 1.0);
  EXPECT_TRUE(spells.contact.empty() && spells.gap.empty());
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

// Contact ends with chance 0.1 and begins with chance 0.025 in a sample: it holds 0.2 of the time, spells last 10
// samples, gaps 40. Spells of 20000 samples number 400: their mean scatters by 5 %.
TEST(ContactSpells, OfATwoStateProcess) {
  std::vector<double> contacts(20000);
  RandomSequence random = test_random(6);
  double state = 0.0;
  for (double& value : contacts) {
    if (random.uniform() < (state > 0.0 ? 0.1 : 0.025)) state = 1.0 - state;
    value = state;
  }
  const ContactSpells spells = contact_spells(contacts, 0.1);
  double mean = 0.0;
  for (const double length : spells.contact) mean += length / static_cast<double>(spells.contact.size());
  EXPECT_NEAR(mean, 1.0, 0.15);
  const IntervalEstimate fraction = contact_fraction(contacts, 0.1, 50.0);
  EXPECT_DOUBLE_EQ(fraction.value, spells.fraction);
  EXPECT_TRUE(fraction.holds(0.2));
  EXPECT_LT(fraction.high - fraction.low, 0.08);
}

}  // namespace
}  // namespace gem
