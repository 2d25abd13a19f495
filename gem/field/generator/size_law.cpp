// Solves and inverts the truncated size laws by Gauss quadrature on panels of equal width in ln x.
#include "gem/field/generator/size_law.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/base/strict_math.h"

namespace gem {
namespace {

constexpr int panels = 256;
constexpr std::array<double, 4> gauss_node = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                              0.8611363115940526};
constexpr std::array<double, 4> gauss_weight = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                                0.3478548451374538};

[[noreturn]] void refuse(const FloesDef& floes) {
  throw Error(ExitCode::scene_rejected, "floes: no truncated size law has mean " + number_text(floes.size_mean_m) +
                                            " m and deviation " + number_text(floes.size_deviation_m) +
                                            " m (sizes lie between " + number_text(floes.size_minimum_m) + " and " +
                                            number_text(floes.size_maximum_m) +
                                            " m); move size_mean_m towards the middle or lower " + "size_deviation_m");
}

}  // namespace

TruncatedSizeLaw::TruncatedSizeLaw(const FloesDef& floes) : law_(floes.size_law), mean_(floes.size_mean_m) {
  const double low = floes.size_minimum_m;
  const double high = floes.size_maximum_m;
  if (!(low > 0.0) || !(mean_ >= low) || !(mean_ <= high) || !(floes.size_deviation_m >= 0.0)) refuse(floes);
  if (floes.size_deviation_m == 0.0) return;
  const double log_low = strict::log(low);
  const double width = (strict::log(high) - log_low) / panels;
  edge_.push_back(low);
  for (int p = 0; p < panels; ++p) {
    for (std::size_t g = 0; g < gauss_node.size(); ++g) {
      node_.push_back(log_low + width * (p + 0.5 * (1.0 + gauss_node[g])));
      node_size_.push_back(strict::exp(node_.back()));
      weight_.push_back(0.5 * width * gauss_weight[g] * node_size_.back());
    }
    edge_.push_back(p + 1 == panels ? high : strict::exp(log_low + width * (p + 1)));
  }
  solve(mean_, floes.size_deviation_m);
  if (!(scale_ > 0.0)) refuse(floes);
  tabulate();
}

double TruncatedSizeLaw::log_density(double log_x, double location, double scale) const {
  if (law_ == SizeLaw::gamma) return (location - 1.0) * log_x - strict::exp(log_x) / scale;
  const double z = (log_x - location) / scale;
  return -0.5 * z * z - log_x;
}

TruncatedSizeLaw::Moments TruncatedSizeLaw::moments(double location, double scale) const {
  std::vector<double> density(node_.size());
  for (std::size_t i = 0; i < node_.size(); ++i) density[i] = log_density(node_[i], location, scale);
  const double largest = *std::max_element(density.begin(), density.end());
  double total = 0.0;
  double first = 0.0;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    density[i] = weight_[i] * strict::exp(density[i] - largest);
    total += density[i];
    first += density[i] * (node_size_[i] - mean_);
  }
  const double shift = first / total;
  double second = 0.0;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    const double x = node_size_[i] - mean_ - shift;
    second += density[i] * x * x;
  }
  return {mean_ + shift, std::sqrt(second / total)};
}

/// Newton's method in (location, ln scale) with halved steps. Leaves scale_ at 0 if it finds no solution.
void TruncatedSizeLaw::solve(double mean, double deviation) {
  const double variation = (deviation / mean) * (deviation / mean);
  double p = law_ == SizeLaw::gamma ? 1.0 / variation : strict::log(mean) - 0.5 * strict::log(1.0 + variation);
  double q = law_ == SizeLaw::gamma ? strict::log(mean * variation) : 0.5 * strict::log(strict::log(1.0 + variation));
  const auto miss = [&](double a, double b) {
    const Moments m = moments(a, strict::exp(b));
    return Vec2{m.mean - mean, m.deviation - deviation};
  };
  constexpr double step = 1e-6;
  Vec2 now = miss(p, q);
  for (int iteration = 0; iteration < 60 && length(now) > 1e-13 * mean; ++iteration) {
    const Vec2 dp = (1.0 / step) * (miss(p + step, q) - now);
    const Vec2 dq = (1.0 / step) * (miss(p, q + step) - now);
    const double determinant = cross(dp, dq);
    const double move_p = -cross(now, dq) / determinant;
    const double move_q = -cross(dp, now) / determinant;
    double share = 1.0;
    Vec2 next = miss(p + move_p, q + move_q);
    while (!(length(next) < length(now)) && share > 1e-6) {
      share *= 0.5;
      next = miss(p + share * move_p, q + share * move_q);
    }
    if (!(length(next) < length(now))) break;
    p += share * move_p;
    q += share * move_q;
    now = next;
  }
  if (!(length(now) < 1e-9 * mean)) return;
  location_ = p;
  scale_ = strict::exp(q);
}

void TruncatedSizeLaw::tabulate() {
  double largest = log_density(node_[0], location_, scale_);
  for (const double x : node_) largest = std::max(largest, log_density(x, location_, scale_));
  cumulative_.assign(1, 0.0);
  for (std::size_t p = 0; p < panels; ++p) {
    double sum = 0.0;
    for (std::size_t g = 4 * p; g < 4 * p + 4; ++g)
      sum += weight_[g] * strict::exp(log_density(node_[g], location_, scale_) - largest);
    cumulative_.push_back(cumulative_.back() + sum);
  }
  const double total = cumulative_.back();
  for (double& c : cumulative_) c /= total;
}

double TruncatedSizeLaw::quantile(double probability) const {
  if (cumulative_.empty()) return mean_;
  const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end(), probability);
  const std::size_t p =
      std::min<std::size_t>(panels, std::max<std::size_t>(1, static_cast<std::size_t>(above - cumulative_.begin()))) -
      1;
  // A panel is less than 1 % wide in size, so a linear density over it is accurate to about 1e-6 of the size.
  const double share = (probability - cumulative_[p]) / (cumulative_[p + 1] - cumulative_[p]);
  const double log_low = strict::log(edge_[p]);
  const double log_high = strict::log(edge_[p + 1]);
  const double at_low = strict::exp(log_density(log_low, location_, scale_) - log_density(log_high, location_, scale_));
  // The density at t in [0, 1] is at_low + (1 - at_low) t, relative to the upper edge. Solve for the t below which the
  // panel has `share` of its probability.
  const double slope = 1.0 - at_low;
  const double t = share * (1.0 + at_low) / (at_low + std::sqrt(at_low * at_low + slope * (1.0 + at_low) * share));
  return edge_[p] + t * (edge_[p + 1] - edge_[p]);
}

}  // namespace gem
