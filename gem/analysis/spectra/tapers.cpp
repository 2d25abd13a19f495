// Slepian tapers from a commuting tridiagonal matrix.
#include "gem/analysis/spectra/tapers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace gem {
namespace {

// The tapers are eigenvectors of a symmetric tridiagonal matrix that commutes with the concentration problem (Slepian
// 1978). The matrix has up to 1e5 rows, and only its few largest eigenvalues are needed:
//   1. bisection with Sturm counts finds each eigenvalue;
//   2. inverse iteration finds its vector, from a sine with the same number of sign changes.
struct Tridiagonal {
  std::vector<double> diagonal;
  std::vector<double> beside;  // beside[i] couples i and i + 1
};

Tridiagonal slepian_matrix(std::size_t length, double time_bandwidth) {
  const double half_band = time_bandwidth / static_cast<double>(length);
  const double cosine = std::cos(2.0 * std::numbers::pi * half_band);
  Tridiagonal matrix{std::vector<double>(length), std::vector<double>(length - 1)};
  for (std::size_t i = 0; i < length; ++i) {
    const double from_middle = 0.5 * static_cast<double>(length - 1) - static_cast<double>(i);
    matrix.diagonal[i] = from_middle * from_middle * cosine;
  }
  for (std::size_t i = 1; i < length; ++i)
    matrix.beside[i - 1] = 0.5 * static_cast<double>(i) * static_cast<double>(length - i);
  return matrix;
}

/// Number of eigenvalues above `value`: the number of positive pivots of the factorised matrix minus `value`.
std::size_t count_above(const Tridiagonal& matrix, double value) {
  std::size_t above = 0;
  double pivot = 1.0;
  for (std::size_t i = 0; i < matrix.diagonal.size(); ++i) {
    const double coupling = i == 0 ? 0.0 : matrix.beside[i - 1] * matrix.beside[i - 1] / pivot;
    pivot = matrix.diagonal[i] - value - coupling;
    if (pivot == 0.0) pivot = -1e-300;
    if (pivot > 0.0) ++above;
  }
  return above;
}

double eigenvalue_from_top(const Tridiagonal& matrix, std::size_t order) {
  double bound = 0.0;
  for (const double value : matrix.diagonal) bound = std::max(bound, std::abs(value));
  for (const double value : matrix.beside) bound = std::max(bound, 2.0 * value);
  double low = -2.0 * bound;
  double high = 2.0 * bound;
  while (true) {
    const double middle = low + 0.5 * (high - low);
    if (middle <= low || middle >= high) return high;
    (count_above(matrix, middle) > order ? low : high) = middle;
  }
}

/// Solves (matrix - shift) x = right; x replaces `right`. Gaussian elimination with exchange of neighbouring rows,
/// which fills one more diagonal. The matrix may be almost singular, because only the direction of x counts.
void solve_shifted(const Tridiagonal& matrix, double shift, std::vector<double>& right) {
  struct Row {
    double at = 0.0, next = 0.0, after = 0.0;  // entries on the diagonal and to the right of it
  };
  const std::size_t n = matrix.diagonal.size();
  const auto beside = [&](std::size_t i) { return i + 1 < n ? matrix.beside[i] : 0.0; };
  std::vector<Row> upper(n);
  upper[0] = {matrix.diagonal[0] - shift, beside(0), 0.0};
  for (std::size_t i = 0; i + 1 < n; ++i) {
    double below = matrix.beside[i];
    Row following = {matrix.diagonal[i + 1] - shift, beside(i + 1), 0.0};
    if (std::abs(below) > std::abs(upper[i].at)) {
      const Row pivot = {below, following.at, following.next};
      below = upper[i].at;
      following = {upper[i].next, upper[i].after, 0.0};
      upper[i] = pivot;
      std::swap(right[i], right[i + 1]);
    }
    const double factor = below / upper[i].at;
    upper[i + 1] = {following.at - factor * upper[i].next, following.next - factor * upper[i].after, 0.0};
    right[i + 1] -= factor * right[i];
  }
  if (upper[n - 1].at == 0.0) upper[n - 1].at = 1e-300;
  for (std::size_t i = n; i-- > 0;) {
    double sum = right[i];
    if (i + 1 < n) sum -= upper[i].next * right[i + 1];
    if (i + 2 < n) sum -= upper[i].after * right[i + 2];
    right[i] = sum / upper[i].at;
  }
}

void normalise(std::vector<double>& vector) {
  double greatest = 0.0;  // scaled first, because squares of the solution may overflow
  for (const double value : vector) greatest = std::max(greatest, std::abs(value));
  for (double& value : vector) value /= greatest;
  const double length = std::sqrt(std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.0));
  for (double& value : vector) value /= length;
}

std::vector<double> sine_guess(std::size_t n, std::size_t order) {
  std::vector<double> guess(n);
  const double turn = std::numbers::pi * static_cast<double>(order + 1) / static_cast<double>(n + 1);
  for (std::size_t i = 0; i < n; ++i) guess[i] = std::sin(turn * static_cast<double>(i + 1));
  return guess;
}

std::vector<double> eigenvector(const Tridiagonal& matrix, std::size_t order) {
  const double value = eigenvalue_from_top(matrix, order);
  // Slightly off the eigenvalue, so that the elimination has non-zero pivots.
  const double shift = value + 1e-13 * std::max(1.0, std::abs(value));
  std::vector<double> vector = sine_guess(matrix.diagonal.size(), order);
  normalise(vector);
  for (int pass = 0; pass < 4; ++pass) {
    solve_shifted(matrix, shift, vector);
    normalise(vector);
  }
  return vector;
}

/// The usual signs: symmetric tapers have a positive sum, antisymmetric ones start positive.
bool wrong_sign(const std::vector<double>& taper, std::size_t order) {
  const auto end = order % 2 == 0 ? taper.end() : taper.begin() + static_cast<std::ptrdiff_t>(taper.size() / 2);
  return std::accumulate(taper.begin(), end, 0.0) < 0.0;
}

}  // namespace

std::vector<std::vector<double>> slepian_tapers(std::size_t length, double time_bandwidth, std::size_t count) {
  const Tridiagonal matrix = slepian_matrix(length, time_bandwidth);
  std::vector<std::vector<double>> tapers;
  for (std::size_t order = 0; order < count; ++order) {
    tapers.push_back(eigenvector(matrix, order));
    if (wrong_sign(tapers.back(), order))
      for (double& value : tapers.back()) value = -value;
  }
  return tapers;
}

}  // namespace gem
