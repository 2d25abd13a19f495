// The largest Lyapunov exponent of one record: how neighbouring states part (Rosenstein, Collins, De Luca 1993).
//
// A narrow-band record of a linear system under noise also gives a positive slope: compare with surrogates.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/analysis/chaos/embedding.h"
#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// Mean ln(distance) of neighbours after each number of samples, from 0 to `steps`; one curve for each of `parts` equal
/// stretches of the record's reference states, whose scatter is the uncertainty.
struct NeighbourDivergence {
  std::vector<std::vector<double>> part;  // curves
  std::vector<double> mean;
};

/// Throws std::invalid_argument if the record is too short for its embedding and steps.
NeighbourDivergence neighbour_divergence(std::span<const double> signal, const Embedding& embedding, std::size_t steps,
                                         std::size_t parts = 10);

/// Slope between two numbers of samples, and its 95 % interval by Student's t over the parts [1/s]. Needs two parts and
/// three samples within the curve, otherwise std::invalid_argument.
IntervalEstimate divergence_rate(const NeighbourDivergence& divergence, double interval_s, std::size_t first,
                                 std::size_t last);

}  // namespace gem
