// Intermittency of contact: how much of the time, in spells how long, with gaps how long.
#pragma once

#include <span>
#include <vector>

#include "gem/analysis/bootstrap.h"
#include "gem/analysis/interval_estimate.h"

namespace gem {

/// Spells cut off by an end of the record are in the fraction but not in the lengths, which would be too short.
struct ContactSpells {
  double fraction = 0.0;        // of the samples with contact
  std::vector<double> contact;  // lengths of whole spells of contact, in order [s]
  std::vector<double> gap;      // lengths of whole gaps [s]
};

/// A sample has contact if it is not zero. All zero for an empty record.
ContactSpells contact_spells(std::span<const double> contacts, double interval_s);

/// The fraction of time with contact and its interval by blocks of `block_s`, longer than spells and gaps are long,
/// within [0, 1]. Where contact never changes, resampling says nothing: there the interval is Wilson's, each block a
/// trial. Needs two blocks, otherwise std::invalid_argument.
IntervalEstimate contact_fraction(std::span<const double> contacts, double interval_s, double block_s,
                                  const Resampling& resampling = {});

}  // namespace gem
