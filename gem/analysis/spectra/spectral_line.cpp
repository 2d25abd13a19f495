// Finds lines by the F-test of the tapered transforms.
#include "gem/analysis/spectra/spectral_line.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/spectra/fourier.h"
#include "gem/analysis/spectra/tapers.h"
#include "gem/analysis/statistics/moments.h"

namespace gem {
namespace {

constexpr std::size_t kPadding = 8;  // F is narrower than a resolution cell, so the grid must be finer

/// The transforms of the record with each taper, and the response of each taper to a line of amplitude 1.
struct TaperedTransforms {
  std::vector<Complexes> transform;
  std::vector<double> line;
};

TaperedTransforms tapered_transforms(std::span<const double> signal, const MultitaperOptions& options) {
  const double mean = moments(signal).mean;
  Fourier fourier(next_fast_length(kPadding * signal.size()));
  TaperedTransforms result;
  std::vector<double> work(signal.size());
  for (const std::vector<double>& taper : slepian_tapers(signal.size(), options.time_bandwidth, options.taper_count)) {
    for (std::size_t i = 0; i < work.size(); ++i) work[i] = (signal[i] - mean) * taper[i];
    result.transform.push_back(fourier.forward(work));
    result.line.push_back(std::accumulate(taper.begin(), taper.end(), 0.0));
  }
  return result;
}

/// A frequency is a candidate if its F is the maximum within half a resolution cell.
bool is_peak(const std::vector<double>& statistic, std::size_t i) {
  const std::size_t begin = i < kPadding / 2 ? 0 : i - kPadding / 2;
  const std::size_t end = std::min(statistic.size(), i + kPadding / 2 + 1);
  return std::max_element(statistic.begin() + static_cast<std::ptrdiff_t>(begin),
                          statistic.begin() + static_cast<std::ptrdiff_t>(end)) -
             statistic.begin() ==
         static_cast<std::ptrdiff_t>(i);
}

}  // namespace

LineTest line_test(std::span<const double> signal, double interval_s, const MultitaperOptions& options) {
  if (signal.size() < 16 || !(interval_s > 0.0) || options.taper_count < 2)
    throw std::invalid_argument("a line test needs 16 samples, a positive interval and two tapers");
  const TaperedTransforms tapered = tapered_transforms(signal, options);
  const std::size_t padded = tapered.transform.front().size();
  const std::size_t tapers = tapered.line.size();
  const double freedom = 2.0 * static_cast<double>(tapers) - 2.0;
  const double line_energy = std::inner_product(tapered.line.begin(), tapered.line.end(), tapered.line.begin(), 0.0);
  LineTest test{1.0 / (static_cast<double>(padded) * interval_s), signal.size(), tapers, {}, {}, {}};
  for (std::size_t i = 0; i <= padded / 2; ++i) {
    std::complex<double> mean = 0.0;
    for (std::size_t k = 0; k < tapers; ++k) mean += tapered.line[k] * tapered.transform[k][i] / line_energy;
    double unexplained = 0.0;
    for (std::size_t k = 0; k < tapers; ++k) unexplained += std::norm(tapered.transform[k][i] - mean * tapered.line[k]);
    const double explained = std::norm(mean) * line_energy;
    test.statistic.push_back(unexplained > 0.0 ? 0.5 * freedom * explained / unexplained : 0.0);
    test.amplitude.push_back(2.0 * std::abs(mean));
    test.significance.push_back(gsl_cdf_fdist_Q(test.statistic.back(), 2.0, freedom));
  }
  return test;
}

std::vector<Line> find_lines(const LineTest& test, double level) {
  const double limit = level > 0.0 ? level : 1.0 / static_cast<double>(test.samples);
  // Within two cells of zero or the Nyquist frequency the tapers pick up the mirror image of a line.
  const std::size_t margin = 2 * kPadding;
  std::vector<Line> lines;
  for (std::size_t i = margin; i + margin < test.statistic.size(); ++i)
    if (test.significance[i] < limit && is_peak(test.statistic, i))
      lines.push_back({test.step * static_cast<double>(i), test.amplitude[i], test.statistic[i], test.significance[i]});
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.statistic > b.statistic; });
  return lines;
}

}  // namespace gem
