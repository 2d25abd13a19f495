// Discrete Fourier transforms of any length; the tables are kept between calls.
#pragma once

#include <gsl/gsl_fft_complex.h>

#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace gem {

using Complexes = std::vector<std::complex<double>>;

/// The smallest number not below `length` without prime factors above 5, which is fast to transform.
std::size_t next_fast_length(std::size_t length);

/// Transforms of one length. A prime length costs its square, so use next_fast_length() where the length is free.
class Fourier {
 public:
  explicit Fourier(std::size_t length);

  /// Sum of signal[i] exp(-2 pi i k / length); a shorter signal is padded with zeros.
  Complexes forward(std::span<const double> signal);
  /// The inverse transform, with the factor 1 / length. `values` must have the length of the transform.
  Complexes inverse(Complexes values);

 private:
  struct Free {
    void operator()(gsl_fft_complex_wavetable* table) const { gsl_fft_complex_wavetable_free(table); }
    void operator()(gsl_fft_complex_workspace* space) const { gsl_fft_complex_workspace_free(space); }
  };
  std::size_t length_;
  std::unique_ptr<gsl_fft_complex_wavetable, Free> table_;
  std::unique_ptr<gsl_fft_complex_workspace, Free> space_;
};

}  // namespace gem
