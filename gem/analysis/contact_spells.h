// Intermittency of contact: how much of the time, in spells how long, with gaps how long.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// One stretch of a record with or without contact. What an end of the record cuts off is a lower bound of its length.
struct Spell {
  double length = 0.0;     // inside the record [s]
  bool begin_seen = true;  // it does not begin with the record
  bool end_seen = true;    // it does not end with the record

  bool cut() const { return !begin_seen || !end_seen; }
};

/// In the order of the record.
struct ContactSpells {
  double fraction = 0.0;  // of the samples with contact
  std::vector<Spell> contact;
  std::vector<Spell> gap;
};

/// A sample has contact if it is not zero. All zero for an empty record.
ContactSpells contact_spells(std::span<const double> contacts, double interval_s);

/// Mean length by the whole time spent in such spells over the number of ends seen [s]: the censored estimator of
/// exponential lengths, so cut spells count with what is seen of them. Empty without an end.
std::optional<double> spell_mean(std::span<const Spell> spells);

/// Median length by Kaplan and Meier, of the spells whose beginning is seen [s]: a cut one only says that it lasted
/// longer. Empty where the survival curve stays above one half.
std::optional<double> spell_median(std::span<const Spell> spells);

/// The longest spell, cut ones with what is seen of them, so the true one is at least as long [s]. Empty without
/// spells.
std::optional<double> longest_spell(std::span<const Spell> spells);

std::size_t cut_spells(std::span<const Spell> spells);

/// The fraction of time with contact and its interval by blocks of `block_s`, longer than spells and gaps are long,
/// within [0, 1]. Where contact never changes, resampling says nothing: there the interval is Wilson's, each block a
/// trial. Needs two blocks, otherwise std::invalid_argument.
IntervalEstimate contact_fraction(std::span<const double> contacts, double interval_s, double block_s,
                                  const Resampling& resampling = {});

}  // namespace gem
