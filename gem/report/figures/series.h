// Records made thin enough to draw without losing what the eye would see.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gem {

/// Indices of at most 2 * bins samples that keep the smallest and the largest of each bin, in time order: extremes
/// survive. A record of at most 2 * bins samples keeps all.
std::vector<std::size_t> envelope(std::span<const double> signal, std::size_t bins);

/// At most `count` evenly spaced indices, the last sample included: for smooth curves.
std::vector<std::size_t> every(std::size_t samples, std::size_t count);

/// First and one-past-last sample within [from, to] of ascending times.
struct SampleRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};
SampleRange samples_within(std::span<const double> time, double from, double to);

}  // namespace gem
