// Wraps the mixed-radix transforms of GSL.
#include "gem/analysis/spectra/fourier.h"

#include <stdexcept>

namespace gem {
namespace {

bool is_fast(std::size_t length) {
  for (const std::size_t factor : {2u, 3u, 5u})
    while (length % factor == 0) length /= factor;
  return length == 1;
}

/// The C++ standard allows an array of complex numbers to be read as pairs of reals.
double* pairs(Complexes& values) { return reinterpret_cast<double*>(values.data()); }

}  // namespace

std::size_t next_fast_length(std::size_t length) {
  if (length == 0) return 1;
  while (!is_fast(length)) ++length;
  return length;
}

Fourier::Fourier(std::size_t length) : length_(length) {
  if (length == 0) throw std::invalid_argument("a transform needs a positive length");
  table_.reset(gsl_fft_complex_wavetable_alloc(length));
  space_.reset(gsl_fft_complex_workspace_alloc(length));
}

Complexes Fourier::forward(std::span<const double> signal) {
  if (signal.size() > length_) throw std::invalid_argument("the signal is longer than the transform");
  Complexes values(length_, 0.0);
  for (std::size_t i = 0; i < signal.size(); ++i) values[i] = signal[i];
  gsl_fft_complex_forward(pairs(values), 1, length_, table_.get(), space_.get());
  return values;
}

Complexes Fourier::inverse(Complexes values) {
  if (values.size() != length_) throw std::invalid_argument("the values do not have the length of the transform");
  gsl_fft_complex_inverse(pairs(values), 1, length_, table_.get(), space_.get());
  return values;
}

}  // namespace gem
