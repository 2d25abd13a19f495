// Principal axes from the covariance matrix of the path.
#include "gem/analysis/orbit.h"

#include <cmath>
#include <stdexcept>

#include "gem/analysis/statistics/moments.h"

namespace gem {

Orbit orbit(std::span<const double> x, std::span<const double> y, double interval_s) {
  if (x.size() < 2 || x.size() != y.size()) throw std::invalid_argument("an orbit needs two samples of both axes");
  Orbit result;
  result.end = static_cast<double>(x.size()) * interval_s;
  result.centre_x = moments(x).mean;
  result.centre_y = moments(y).mean;
  double xx = 0.0, xy = 0.0, yy = 0.0, swept = 0.0, possible = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = x[i] - result.centre_x;
    const double v = y[i] - result.centre_y;
    xx += u * u;
    xy += u * v;
    yy += v * v;
    if (i == 0) continue;
    const double before_u = x[i - 1] - result.centre_x;
    const double before_v = y[i - 1] - result.centre_y;
    swept += before_u * v - before_v * u;
    possible += 0.5 * (std::hypot(before_u, before_v) + std::hypot(u, v)) * std::hypot(u - before_u, v - before_v);
  }
  const auto count = static_cast<double>(x.size());
  const double middle = 0.5 * (xx + yy) / count;
  const double spread = std::hypot(0.5 * (xx - yy), xy) / count;
  result.major = std::sqrt(middle + spread);
  result.minor = std::sqrt(std::fmax(0.0, middle - spread));
  result.angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  result.turning = possible > 0.0 ? swept / possible : 0.0;
  return result;
}

std::vector<Orbit> orbit_over_time(std::span<const double> x, std::span<const double> y, double interval_s,
                                   double stretch_s) {
  const auto length = static_cast<std::size_t>(std::llround(stretch_s / interval_s));
  if (length < 2 || x.size() != y.size()) throw std::invalid_argument("a stretch of an orbit needs two samples");
  std::vector<Orbit> orbits;
  for (std::size_t begin = 0; begin + length <= x.size(); begin += length) {
    Orbit part = orbit(x.subspan(begin, length), y.subspan(begin, length), interval_s);
    part.start = static_cast<double>(begin) * interval_s;
    part.end += part.start;
    orbits.push_back(part);
  }
  return orbits;
}

}  // namespace gem
