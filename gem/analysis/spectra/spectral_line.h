// Thomson's F-test for a line (a sine of constant amplitude) in noise.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/analysis/spectra/spectrum.h"

namespace gem {

/// F at every frequency: power explained by a line over the power left unexplained.
struct LineTest {
  double step = 0.0;                 // spacing of the frequencies, which start at 0 [Hz]
  std::size_t samples = 0;           // of the record
  std::size_t tapers = 0;            // without a line, F has 2 and 2 tapers - 2 degrees of freedom
  std::vector<double> statistic;     // F
  std::vector<double> amplitude;     // of the best line [unit]
  std::vector<double> significance;  // probability of an F at least as large without a line
};

/// F-test of the mean-removed record (Thomson 1982). Throws as eigenspectra(), and for fewer than two tapers.
LineTest line_test(std::span<const double> signal, double interval_s, const MultitaperOptions& options = {});

struct Line {
  double frequency = 0.0;  // [Hz]
  double amplitude = 0.0;  // [unit]
  double statistic = 0.0;
  double significance = 0.0;
};

/// Lines whose significance is below `level`, largest F first, at most one per resolution cell. `level` 0 means 1 / N
/// for N independent frequencies: then one frequency passes by chance on average.
std::vector<Line> find_lines(const LineTest& test, double level = 0.0);

}  // namespace gem
