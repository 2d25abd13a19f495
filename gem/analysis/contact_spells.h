// Intermittency of contact: the share of time with contact, and the lengths of spells and gaps.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// One stretch of a record with or without contact. If an end of the record cuts it, its length is a lower bound.
struct Spell {
  double length = 0.0;     // inside the record [s]
  bool begin_seen = true;  // it starts after the record starts
  bool end_seen = true;    // it ends before the record ends

  bool cut() const { return !begin_seen || !end_seen; }
};

/// Spells and gaps in the order of the record.
struct ContactSpells {
  double fraction = 0.0;  // of the samples with contact
  std::vector<Spell> contact;
  std::vector<Spell> gap;
};

/// A sample has contact if it is not zero. An empty record gives zeros.
ContactSpells contact_spells(std::span<const double> contacts, double interval_s);

/// Mean length [s]: total time in the spells over the number of observed ends. This is the censored estimator for
/// exponential lengths, in which cut spells count with their observed part. Empty if no end is observed.
std::optional<double> spell_mean(std::span<const Spell> spells);

/// Median length [s] by the Kaplan-Meier estimator, over spells whose start is observed; a spell without end counts as
/// longer than its observed part. Empty if the survival curve stays above one half.
std::optional<double> spell_median(std::span<const Spell> spells);

/// The longest spell [s]. A cut spell counts with its observed part, so this is a lower bound. Empty without spells.
std::optional<double> longest_spell(std::span<const Spell> spells);

std::size_t cut_spells(std::span<const Spell> spells);

/// Fraction of time with contact and its 95 % interval, within [0, 1], from blocks of `block_s`, which must be longer
/// than typical spells and gaps. If contact never changes, resampling has no scatter; the interval is then Wilson's
/// with each block as one trial. Throws std::invalid_argument with fewer than two blocks.
IntervalEstimate contact_fraction(std::span<const double> contacts, double interval_s, double block_s,
                                  const Resampling& resampling = {});

}  // namespace gem
