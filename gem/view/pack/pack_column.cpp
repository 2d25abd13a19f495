// Second differences suit what moves smoothly, first ones what is noisy.
#include "gem/view/pack/pack_column.h"

#include <cmath>
#include <cstdint>

namespace gem::view {

namespace {

using Steps = std::vector<std::int64_t>;

constexpr double row_steps_maximum = 1e15;

Steps differences(const Steps& values, int order) {
  Steps out(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::int64_t one = i > 0 ? values[i - 1] : 0;
    const std::int64_t two = i > 1 ? values[i - 2] : one;
    out[i] = values[i] - (order == 2 && i > 0 ? 2 * one - two : one);
  }
  return out;
}

double size_of(const Steps& values) {
  double sum = 0.0;
  for (const std::int64_t value : values) sum += std::abs(double(value));
  return sum;
}

}  // namespace

int write_column(ByteWriter& out, const std::vector<double>& values, double step) {
  Steps whole(values.size());
  std::vector<std::uint8_t> missing(values.size()), shifted(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double steps = std::floor(values[i] / step + 0.5);
    missing[i] = !(std::abs(steps) <= row_steps_maximum);
    whole[i] = missing[i] ? (i > 0 ? whole[i - 1] : 0) : static_cast<std::int64_t>(steps);
    shifted[i] = i > 0 ? missing[i - 1] : 0;
  }
  write_changes(out, shifted, missing);
  const Steps first = differences(whole, 1), second = differences(whole, 2);
  const int order = size_of(second) < size_of(first) ? 2 : 1;
  for (const std::int64_t value : order == 2 ? second : first) out.signed_whole(value);
  return order;
}

}  // namespace gem::view
