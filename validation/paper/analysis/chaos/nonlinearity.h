// Statistics that are zero for a linear normal process: asymmetry in time, and predictability beyond the spectrum.
#pragma once

#include <cstddef>
#include <span>

#include "validation/paper/analysis/chaos/embedding.h"

namespace gem {

/// Skewness of the differences over `lag` samples. Its mean is zero for a record that is statistically equal backwards,
/// and positive for slow falls and quick rises. 0 for a constant record. Throws std::invalid_argument unless there are
/// more than `lag` samples.
double time_reversal_asymmetry(std::span<const double> signal, std::size_t lag);

struct NeighbourForecast {
  Embedding embedding;
  std::size_t horizon = 1;      // samples ahead
  std::size_t neighbours = 10;  // whose futures are averaged
};

/// Error of predicting each state's future by the mean future of its neighbours, over the standard deviation of the
/// record: 0 is perfect, about 1 is no forecast. Throws std::invalid_argument for a constant record or one not longer
/// than embedding and horizon.
double prediction_error(std::span<const double> signal, const NeighbourForecast& forecast = {});

}  // namespace gem
