// Runs of equal state in a record of contacts.
#include "gem/analysis/contact_spells.h"

#include <algorithm>
#include <cmath>

#include "gem/analysis/moments.h"
#include "gem/analysis/proportion.h"

namespace gem {

ContactSpells contact_spells(std::span<const double> contacts, double interval_s) {
  ContactSpells spells;
  spells.fraction = intermittency(contacts);
  std::size_t begin = 0;
  bool whole = false;  // the first spell may have begun before the record
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    const bool was = contacts[i - 1] != 0.0;
    if ((contacts[i] != 0.0) == was) continue;
    if (whole) (was ? spells.contact : spells.gap).push_back(static_cast<double>(i - begin) * interval_s);
    begin = i;
    whole = true;
  }
  return spells;
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
