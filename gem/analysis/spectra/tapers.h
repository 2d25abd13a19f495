// Slepian (DPSS) tapers: windows of a given length with the most energy within a band.
#pragma once

#include <cstddef>
#include <vector>

namespace gem {

/// The first `count` discrete prolate spheroidal sequences of `length` samples with time-bandwidth product
/// `time_bandwidth` (NW), most concentrated first. They are orthogonal and have unit energy. Symmetric ones have a
/// positive sum, antisymmetric ones start positive. Needs length > 2 * time_bandwidth and count <= length.
std::vector<std::vector<double>> slepian_tapers(std::size_t length, double time_bandwidth, std::size_t count);

}  // namespace gem
