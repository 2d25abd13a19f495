// Slepian tapers from a commuting tridiagonal matrix.
#include "gem/analysis/spectra/tapers.h"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gem {
namespace {

// The tapers are the eigenvectors of a symmetric tridiagonal matrix that commutes with the concentration problem
// (Slepian 1978). Only the few largest eigenvalues are wanted of a matrix of 1e5 rows:
//   1. bisection with Sturm counts finds each eigenvalue;
//   2. inverse iteration from a sine of the same number of sign changes finds its vector.
struct Tridiagonal {
  Eigen::VectorXd diagonal;
  Eigen::VectorXd beside;  // beside[i] couples i and i + 1
};

Tridiagonal slepian_matrix(std::size_t length, double time_bandwidth) {
  const auto n = static_cast<Eigen::Index>(length);
  const double half_band = time_bandwidth / static_cast<double>(length);
  const double cosine = std::cos(2.0 * std::numbers::pi * half_band);
  Tridiagonal matrix{Eigen::VectorXd(n), Eigen::VectorXd(n - 1)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double from_middle = 0.5 * static_cast<double>(n - 1 - 2 * i);
    matrix.diagonal[i] = from_middle * from_middle * cosine;
  }
  for (Eigen::Index i = 1; i < n; ++i) matrix.beside[i - 1] = 0.5 * static_cast<double>(i) * static_cast<double>(n - i);
  return matrix;
}

/// Number of eigenvalues above `value`: positive pivots of the factorised matrix minus `value`.
std::size_t count_above(const Tridiagonal& matrix, double value) {
  std::size_t above = 0;
  double pivot = 1.0;
  for (Eigen::Index i = 0; i < matrix.diagonal.size(); ++i) {
    const double coupling = i == 0 ? 0.0 : matrix.beside[i - 1] * matrix.beside[i - 1] / pivot;
    pivot = matrix.diagonal[i] - value - coupling;
    if (pivot == 0.0) pivot = -1e-300;
    if (pivot > 0.0) ++above;
  }
  return above;
}

double eigenvalue_from_top(const Tridiagonal& matrix, std::size_t order) {
  const double bound = matrix.diagonal.cwiseAbs().maxCoeff() + 2.0 * matrix.beside.maxCoeff();
  double low = -bound;
  double high = bound;
  while (true) {
    const double middle = low + 0.5 * (high - low);
    if (middle <= low || middle >= high) return high;
    (count_above(matrix, middle) > order ? low : high) = middle;
  }
}

Eigen::SparseMatrix<double> shifted(const Tridiagonal& matrix, double shift) {
  const Eigen::Index n = matrix.diagonal.size();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < n; ++i) {
    const int row = static_cast<int>(i);
    entries.emplace_back(row, row, matrix.diagonal[i] - shift);
    if (i + 1 == n) continue;
    entries.emplace_back(row, row + 1, matrix.beside[i]);
    entries.emplace_back(row + 1, row, matrix.beside[i]);
  }
  Eigen::SparseMatrix<double> sparse(n, n);
  sparse.setFromTriplets(entries.begin(), entries.end());
  return sparse;
}

Eigen::VectorXd sine_guess(Eigen::Index n, std::size_t order) {
  Eigen::VectorXd guess(n);
  const double turn = std::numbers::pi * static_cast<double>(order + 1) / static_cast<double>(n + 1);
  for (Eigen::Index i = 0; i < n; ++i) guess[i] = std::sin(turn * static_cast<double>(i + 1));
  return guess.normalized();
}

Eigen::VectorXd eigenvector(const Tridiagonal& matrix, std::size_t order) {
  const double value = eigenvalue_from_top(matrix, order);
  // Just off the eigenvalue, so that the factorisation exists.
  const double shift = value + 1e-13 * std::max(1.0, std::abs(value));
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::NaturalOrdering<int>> factor(shifted(matrix, shift));
  Eigen::VectorXd vector = sine_guess(matrix.diagonal.size(), order);
  for (int pass = 0; pass < 4; ++pass) vector = factor.solve(vector).eval().normalized();
  return vector;
}

/// The usual signs: symmetric tapers sum to a positive number, antisymmetric ones begin positive.
bool wrong_sign(const Eigen::VectorXd& taper, std::size_t order) {
  if (order % 2 == 0) return taper.sum() < 0.0;
  return taper.head(taper.size() / 2).sum() < 0.0;
}

}  // namespace

std::vector<std::vector<double>> slepian_tapers(std::size_t length, double time_bandwidth, std::size_t count) {
  const Tridiagonal matrix = slepian_matrix(length, time_bandwidth);
  std::vector<std::vector<double>> tapers;
  for (std::size_t order = 0; order < count; ++order) {
    Eigen::VectorXd taper = eigenvector(matrix, order);
    if (wrong_sign(taper, order)) taper = -taper;
    tapers.emplace_back(taper.begin(), taper.end());
  }
  return tapers;
}

}  // namespace gem
