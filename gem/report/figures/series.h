// Thins records for drawing without visible loss.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gem {

/// Indices, in time order, of the smallest and the largest sample of each of `bins` bins, so that extremes survive. A
/// record of at most 2 * bins samples is kept whole.
std::vector<std::size_t> envelope(std::span<const double> signal, std::size_t bins);

/// At most `count` evenly spaced indices including the last sample, for smooth curves.
std::vector<std::size_t> every(std::size_t samples, std::size_t count);

/// First sample and one past the last sample within [from, to], for ascending times.
struct SampleRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};
SampleRange samples_within(std::span<const double> time, double from, double to);

}  // namespace gem
