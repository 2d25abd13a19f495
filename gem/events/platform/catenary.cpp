// Closed form of the elastic catenary, and its curve of tension over distance.
#include "gem/events/platform/catenary.h"

#include <algorithm>
#include <cmath>

#include "gem/base/strict_math.h"

namespace gem {
namespace {

/// asinh y for y >= 0.
double area_sine(double y) { return strict::log1p(y + y * (y / (1.0 + std::sqrt(1.0 + y * y)))); }

double hypotenuse(double a, double b) { return std::sqrt(a * a + b * b); }

/// Height of a line that hangs with these tensions [m], and its derivative over V [m/N].
struct Height {
  double z, slope;
};
Height height_of(const LineProperties& line, double h, double v) {
  const double w = line.weight, hanging = w * line.length, t = hypotenuse(h, v);
  if (v < hanging)
    return {v * (v / (w * (t + h))) + v * v / (2.0 * line.stiffness * w), (v / t + v / line.stiffness) / w};
  const double va = v - hanging, ta = hypotenuse(h, va);
  return {line.length * (v + va) / (t + ta) + line.length * (v - 0.5 * hanging) / line.stiffness,
          (v / t - (ta > 0.0 ? va / ta : 1.0)) / w + line.length / line.stiffness};
}

CurveSample sample_at(const LineProperties& line, double h) {
  const double v = vertical_tension(line, h), t = hypotenuse(h, v);
  const LineShape shape = line_shape(line, h, v);
  const double v_of_h = -shape.z_of_h / shape.z_of_v;
  const double slope = 1.0 / (shape.x_of_h + shape.z_of_h * v_of_h);
  return {shape.x, h, slope, t, slope * (h + v * v_of_h) / t};
}

/// Appends the samples after `from` up to `to`. Halves the stretch where its middle is off the smooth curve, as where
/// the last part of a line leaves the seabed.
void add_stretch(const LineProperties& line, const CurveSample& from, const CurveSample& to, int halvings,
                 std::vector<CurveSample>& samples) {
  constexpr double accepted = 1e-7;  // of the tension
  const CurveSample middle = sample_at(line, std::sqrt(from.force * to.force));
  const std::vector<CurveKnot> piece = smooth_curve({from, to});
  const CurvePoint found = curve_at(piece.data(), 1, middle.at);
  const bool off = std::fabs(found.force - middle.force) > accepted * middle.force ||
                   std::fabs(found.beside - middle.beside) > accepted * middle.beside;
  if (off && halvings > 0) {
    add_stretch(line, from, middle, halvings - 1, samples);
    add_stretch(line, middle, to, halvings - 1, samples);
    return;
  }
  samples.push_back(to);
}

}  // namespace

LineShape line_shape(const LineProperties& line, double h, double v) {
  const double w = line.weight, hanging = w * line.length, t = hypotenuse(h, v);
  const Height height = height_of(line, h, v);
  LineShape shape;
  shape.z = height.z;
  shape.z_of_v = height.slope;
  const double bow = area_sine(v / h), stretch = line.length / line.stiffness;
  if (v < hanging) {
    shape.x = line.length - v / w + h / w * bow + h * stretch;
    shape.x_of_h = (bow - v / t) / w + stretch;
    shape.z_of_h = (h / t - 1.0) / w;
    return shape;
  }
  const double va = v - hanging, ta = hypotenuse(h, va), bow_a = area_sine(va / h);
  shape.x = h / w * (bow - bow_a) + h * stretch;
  shape.x_of_h = ((bow - v / t) - (bow_a - va / ta)) / w + stretch;
  shape.z_of_h = (h / t - h / ta) / w;
  return shape;
}

double vertical_tension(const LineProperties& line, double h) {
  const double scale = line.weight * line.height;
  double low = 0.0, high = scale;
  while (height_of(line, h, high).z < line.height) high *= 2.0;
  double v = std::min(high, std::sqrt(scale * (scale + 2.0 * h)));  // of a line that does not stretch
  for (int k = 0; k < 200; ++k) {
    const Height at = height_of(line, h, v);
    (at.z < line.height ? low : high) = v;
    const double next = v - (at.z - line.height) / at.slope;
    const double kept = next > low && next < high ? next : 0.5 * (low + high);
    if (std::fabs(kept - v) <= 1e-15 * scale) return kept;
    v = kept;
  }
  return v;
}

std::vector<CurveSample> line_samples(const LineProperties& line, double most) {
  const double at_rest = vertical_tension(line, 0.0);
  std::vector<CurveSample> samples = {{line.length - at_rest / line.weight, 0.0, 0.0, at_rest, 0.0}};
  // taut at the end, so that the last slope, that of the stretch, goes on
  const double end = std::max({most, 20.0 * line.weight * line.length, 0.05 * line.stiffness});
  double h = 1e-4 * line.weight * line.height;
  samples.push_back(sample_at(line, h));
  while (h < end) {
    h *= 1.1;
    add_stretch(line, CurveSample(samples.back()), sample_at(line, h), 10, samples);
  }
  return samples;
}

}  // namespace gem
