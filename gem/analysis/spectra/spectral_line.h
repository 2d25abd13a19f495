// Thomson's F-test: is there a line (a sine of constant amplitude) at a frequency, beside the noise around it?
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/analysis/spectra/spectrum.h"

namespace gem {

/// F at every frequency: power explained by a line over what the tapers leave unexplained.
struct LineTest {
  double step = 0.0;                 // spacing of the frequencies, the first is 0 [Hz]
  std::size_t samples = 0;           // of the record
  std::size_t tapers = 0;            // F has 2 and 2 tapers - 2 degrees of freedom without a line
  std::vector<double> statistic;     // F
  std::vector<double> amplitude;     // of the best line [unit]
  std::vector<double> significance;  // chance of so large an F without a line
};

/// F-test of the mean-removed record (Thomson 1982). Errors as for eigenspectra(), and for fewer than two tapers.
LineTest line_test(std::span<const double> signal, double interval_s, const MultitaperOptions& options = {});

struct Line {
  double frequency = 0.0;  // [Hz]
  double amplitude = 0.0;  // [unit]
  double statistic = 0.0;
  double significance = 0.0;
};

/// Lines whose significance is below `level`, strongest F first, no two within one resolution cell. One of N
/// independent frequencies passes 1/N by chance: that is the level taken for 0.
std::vector<Line> find_lines(const LineTest& test, double level = 0.0);

}  // namespace gem
