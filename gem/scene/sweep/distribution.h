// Distributions from which a sweep draws numbers, by their quantiles.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gem {

/// A law of one number. Each kind uses the members that its line names.
struct Distribution {
  enum class Law { uniform, normal, lognormal, quantiles, values };
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Law law = Law::uniform;
  double low = -infinity;  // uniform, normal, lognormal: no value lies outside [low, high]
  double high = infinity;
  double mean = 0.0;                                 // normal, lognormal: of the law without its bounds
  double deviation = 0.0;                            // normal, lognormal: the standard deviation, > 0
  std::vector<std::pair<double, double>> quantiles;  // probability from 0 to 1 and value; linear between
  std::vector<double> values;                        // each with its weight
  std::vector<double> weights;
  bool whole = false;  // only whole numbers: each of low ... high alike (uniform), else rounded to the nearest

  /// The value that is not exceeded with probability u, 0 < u < 1. The same bits on every machine.
  double quantile(double u) const;
  /// No value lies below or above.
  double lowest() const;
  double highest() const;
  /// "uniform from 0.1 to 0.5".
  std::string text() const;

  /// Called once all members are set: finds the probabilities of the bounds. Returns the share of the unbounded law
  /// that lies between them; 1 for laws without bounds.
  double prepare();

 private:
  double unbounded(double u) const;
  double probability_below(double x) const;
  double probability_low_ = 0.0, probability_high_ = 1.0;
};

}  // namespace gem
