// Runs with drawn inputs, in the form that the sensitivity analysis needs.
#pragma once

#include <cstddef>
#include <vector>

namespace gem {

/// Draws of independent inputs and one result of each run. A draw may be made several times, with another seed of the
/// field each time: then it has several outputs.
struct DrawnRuns {
  std::vector<std::vector<double>> inputs;   // of each input, one value for each draw
  std::vector<std::vector<double>> outputs;  // of each draw, one value for each repeat; all draws have as many

  std::size_t draws() const { return outputs.size(); }
  std::size_t repeats() const { return outputs.empty() ? 0 : outputs.front().size(); }
};

/// A Saltelli design: the output of each draw with all inputs from the set A, all from B, and A with one from B.
struct SaltelliRuns {
  std::vector<double> a, b;
  std::vector<std::vector<double>> a_with_b;  // of each input
};

/// Ranks from 1; equal values share the mean of their ranks.
std::vector<double> ranks(const std::vector<double>& values);

/// The same runs with ranks in the place of inputs and of outputs (over all repeats).
DrawnRuns ranked(const DrawnRuns& runs);

}  // namespace gem
