// Finds stretches with and without contact in a record.
#include "gem/analysis/contact_spells.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gem/analysis/statistics/moments.h"
#include "gem/analysis/statistics/proportion.h"

namespace gem {
namespace {

constexpr double kRounding = 1e-9;  // rounding of a product of shares

}  // namespace

ContactSpells contact_spells(std::span<const double> contacts, double interval_s) {
  ContactSpells spells;
  spells.fraction = intermittency(contacts);
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= contacts.size(); ++i) {
    const bool touching = contacts[begin] != 0.0;
    const bool ends = i < contacts.size();
    if (ends && (contacts[i] != 0.0) == touching) continue;
    (touching ? spells.contact : spells.gap).push_back({static_cast<double>(i - begin) * interval_s, begin > 0, ends});
    begin = i;
  }
  return spells;
}

std::optional<double> spell_mean(std::span<const Spell> spells) {
  double time = 0.0;
  std::size_t ends = 0;
  for (const Spell& spell : spells) {
    time += spell.length;
    ends += spell.end_seen ? 1 : 0;
  }
  if (ends == 0) return std::nullopt;
  return time / static_cast<double>(ends);
}

std::optional<double> spell_median(std::span<const Spell> spells) {
  std::vector<Spell> known;
  std::copy_if(spells.begin(), spells.end(), std::back_inserter(known),
               [](const Spell& spell) { return spell.begin_seen; });
  // Of equal lengths the complete spells come first: a cut spell was still going on when they ended.
  std::sort(known.begin(), known.end(), [](const Spell& a, const Spell& b) {
    return a.length != b.length ? a.length < b.length : a.end_seen && !b.end_seen;
  });
  double surviving = 1.0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto lasting = static_cast<double>(known.size() - i);
    if (known[i].end_seen) surviving *= (lasting - 1.0) / lasting;
    if (known[i].end_seen && surviving <= 0.5 + kRounding) return known[i].length;
  }
  return std::nullopt;
}

std::optional<double> longest_spell(std::span<const Spell> spells) {
  if (spells.empty()) return std::nullopt;
  return std::max_element(spells.begin(), spells.end(),
                          [](const Spell& a, const Spell& b) { return a.length < b.length; })
      ->length;
}

std::size_t cut_spells(std::span<const Spell> spells) {
  return static_cast<std::size_t>(std::count_if(spells.begin(), spells.end(), [](const Spell& s) { return s.cut(); }));
}

IntervalEstimate contact_fraction(std::span<const double> contacts, double interval_s, double block_s,
                                  const Resampling& resampling) {
  std::vector<double> touching(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) touching[i] = contacts[i] != 0.0 ? 1.0 : 0.0;
  const auto block = static_cast<std::size_t>(std::llround(block_s / interval_s));
  IntervalEstimate fraction = moving_block_mean(touching, block, resampling);
  const std::size_t blocks = touching.size() / block;
  if (fraction.value == 0.0) return wilson_share(0, blocks, resampling.confidence);
  if (fraction.value == 1.0) return wilson_share(blocks, blocks, resampling.confidence);
  fraction.low = std::max(fraction.low, 0.0);
  fraction.high = std::min(fraction.high, 1.0);
  return fraction;
}

}  // namespace gem
