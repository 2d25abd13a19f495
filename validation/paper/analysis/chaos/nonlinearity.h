// Statistics that a linear normal process does not have: asymmetry in time, and predictability beyond its spectrum.
#pragma once

#include <cstddef>
#include <span>

#include "validation/paper/analysis/chaos/embedding.h"

namespace gem {

/// Skewness of the differences over `lag` samples: zero on average for a record that reads the same backwards, positive
/// for slow falls and quick rises. 0 for a constant record. Needs more than `lag` samples, otherwise
/// std::invalid_argument.
double time_reversal_asymmetry(std::span<const double> signal, std::size_t lag);

struct Prediction {
  Embedding embedding;
  std::size_t horizon = 1;      // samples ahead
  std::size_t neighbours = 10;  // whose futures are averaged
};

/// Error of predicting each state's future by the mean future of its neighbours, over the record's standard deviation:
/// 0 for a perfect prediction, about 1 for none. Needs a record longer than embedding and horizon and not constant,
/// otherwise std::invalid_argument.
double prediction_error(std::span<const double> signal, const Prediction& prediction = {});

}  // namespace gem
