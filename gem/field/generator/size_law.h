// The truncated size laws of the floes, solved for the requested mean and deviation.
#pragma once

#include <array>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

/// A law on [minimum, maximum] whose two parameters give exactly the requested mean and deviation. Sizes in m.
///   lognormal: density ~ exp(-(ln x - location)^2 / (2 scale^2)) / x    (location = mu_ln, scale = sigma_ln)
///   gamma:     density ~ x^(location - 1) exp(-x / scale)               (location = k, scale = theta [m])
/// A deviation of 0 gives every floe the mean size.
class TruncatedSizeLaw {
 public:
  /// Throws Error(scene_rejected) if no parameters give the mean and deviation.
  explicit TruncatedSizeLaw(const FloesDef& floes);

  double location() const { return location_; }
  double scale() const { return scale_; }
  /// The size [m] below which the share `probability` in (0, 1) of the floes lies.
  double quantile(double probability) const;

 private:
  struct Moments {
    double mean = 0.0;
    double deviation = 0.0;
  };
  double log_density(double log_x, double location, double scale) const;
  Moments moments(double location, double scale) const;
  void solve(double mean, double deviation);
  void tabulate();

  SizeLaw law_;
  double mean_;
  double location_ = 0.0;
  double scale_ = 0.0;
  std::vector<double> node_;        // ln x at the Gauss points, four per panel
  std::vector<double> node_size_;   // x at the Gauss points [m]
  std::vector<double> weight_;      // weight dx of each Gauss point [m]
  std::vector<double> edge_;        // panel edges [m]
  std::vector<double> cumulative_;  // probability below each edge
};

}  // namespace gem
