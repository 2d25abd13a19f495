#include "bench/splitting/body_factor.h"

#include <algorithm>
#include <cstring>

#include "gem/base/pack.h"

namespace gem::bench {
namespace {

/// Inverse of a symmetric positive definite 3 x 3 block.
void invert(const float* m, float* inverse) {
  const double a = m[0], b = m[1], c = m[2], d = m[4], e = m[5], f = m[8];
  const double aa = d * f - e * e, ab = c * e - b * f, ac = b * e - c * d;
  const double scale = 1.0 / (a * aa + b * ab + c * ac);
  inverse[0] = static_cast<float>(aa * scale);
  inverse[1] = inverse[3] = static_cast<float>(ab * scale);
  inverse[2] = inverse[6] = static_cast<float>(ac * scale);
  inverse[4] = static_cast<float>((a * f - c * c) * scale);
  inverse[5] = inverse[7] = static_cast<float>((b * c - a * e) * scale);
  inverse[8] = static_cast<float>((a * d - b * b) * scale);
}

}  // namespace

void BodyFactor::analyse(std::int32_t bodies, std::span<const std::pair<std::int32_t, std::int32_t>> pairs) {
  // rows of each column before elimination
  own_first_.assign(bodies + 1, 0);
  for (const auto& [column, row] : pairs) ++own_first_[column + 1];
  for (std::int32_t k = 0; k < bodies; ++k) own_first_[k + 1] += own_first_[k];
  own_row_.resize(pairs.size());
  mark_.assign(own_first_.begin(), own_first_.end());
  for (const auto& [column, row] : pairs) own_row_[mark_[column]++] = row;
  // the column of a body takes the rows of its children, those that have it as their first row
  first_.assign(1, 0);
  row_.clear();
  first_child_.assign(bodies, -1);
  next_of_parent_.assign(bodies, -1);
  mark_.assign(bodies, -1);
  for (std::int32_t column = 0; column < bodies; ++column) {
    const std::size_t begin = row_.size();
    const auto take = [&](std::int32_t row) {
      if (row == column || mark_[row] == column) return;
      mark_[row] = column;
      row_.push_back(row);
    };
    for (std::int32_t k = own_first_[column]; k < own_first_[column + 1]; ++k) take(own_row_[k]);
    for (std::int32_t child = first_child_[column]; child >= 0; child = next_of_parent_[child])
      for (std::int32_t k = first_[child]; k < first_[child + 1]; ++k) take(row_[k]);
    std::sort(row_.begin() + begin, row_.end());
    first_.push_back(static_cast<std::int32_t>(row_.size()));
    if (row_.size() > begin) {
      next_of_parent_[column] = first_child_[row_[begin]];
      first_child_[row_[begin]] = column;
    }
  }
  constexpr int padding = 3;  // rows_of() reads so far past the last block
  lower_.resize(block * row_.size() + padding);
  diagonal_.resize(block * bodies);
  inverse_.resize(block * bodies + padding);
}

void BodyFactor::reset() {
  std::fill(lower_.begin(), lower_.end(), 0.0F);
  std::fill(diagonal_.begin(), diagonal_.end(), 0.0F);
  for (std::int32_t k = 0; k < bodies(); ++k)
    diagonal_[block * k] = diagonal_[block * k + 4] = diagonal_[block * k + 8] = 1.0F;
}

float* BodyFactor::below(std::int32_t row, std::int32_t column) {
  const auto at = std::lower_bound(row_.begin() + first_[column], row_.begin() + first_[column + 1], row);
  return &lower_[block * (at - row_.begin())];
}

GEM_CLONES void BodyFactor::factor() {
  for (std::int32_t column = 0; column < bodies(); ++column) {
    float* const inverse = &inverse_[block * column];
    invert(&diagonal_[block * column], inverse);
    const std::int32_t end = first_[column + 1];
    for (std::int32_t k = first_[column]; k < end; ++k) {
      float* const l = &lower_[block * k];
      float a[block];
      std::memcpy(a, l, sizeof a);
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          l[3 * r + c] = a[3 * r] * inverse[c] + a[3 * r + 1] * inverse[3 + c] + a[3 * r + 2] * inverse[6 + c];
      float* const d = &diagonal_[block * row_[k]];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          d[3 * r + c] -= l[3 * r] * a[3 * c] + l[3 * r + 1] * a[3 * c + 1] + l[3 * r + 2] * a[3 * c + 2];
      std::int32_t at = first_[row_[k]];
      for (std::int32_t j = k + 1; j < end; ++j) {
        while (row_[at] != row_[j]) ++at;
        float* const target = &lower_[block * at];
        const float* const other = &lower_[block * j];
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            target[3 * r + c] -=
                other[3 * r] * l[3 * c] + other[3 * r + 1] * l[3 * c + 1] + other[3 * r + 2] * l[3 * c + 2];
      }
    }
  }
}

namespace {

typedef std::int32_t HalfMask __attribute__((vector_size(16)));

/// Three rows of a block, each with one number too many. Not for the last numbers of a list, unless it is padded.
struct BlockRows {
  FloatHalf row[3];
};

GEM_INLINE BlockRows rows_of(const float* block) {
  BlockRows rows;
  for (int r = 0; r < 3; ++r) __builtin_memcpy(&rows.row[r], block + 3 * r, sizeof rows.row[r]);
  return rows;
}

GEM_INLINE BlockRows transposed(const BlockRows& m) {
  const FloatHalf low = __builtin_shuffle(m.row[0], m.row[1], HalfMask{0, 4, 1, 5});   // 00 10 01 11
  const FloatHalf high = __builtin_shuffle(m.row[0], m.row[1], HalfMask{2, 6, 2, 6});  // 02 12
  return {{__builtin_shuffle(low, m.row[2], HalfMask{0, 1, 4, 4}),
           __builtin_shuffle(low, m.row[2], HalfMask{2, 3, 5, 5}),
           __builtin_shuffle(high, m.row[2], HalfMask{0, 1, 6, 6})}};
}

/// Half a row or a whole one: the three motions of a body, once or twice.
GEM_INLINE FloatHalf spread(FloatHalf x, int k) { return __builtin_shuffle(x, HalfMask{k, k, k, k}); }
GEM_INLINE FloatPack spread(FloatPack x, int k) {
  return __builtin_shuffle(x, FloatMask{k, k, k, k, 4 + k, 4 + k, 4 + k, 4 + k});
}
GEM_INLINE FloatHalf widen(FloatHalf x, FloatHalf) { return x; }
GEM_INLINE FloatPack widen(FloatHalf x, FloatPack) { return __builtin_shufflevector(x, x, 0, 1, 2, 3, 4, 5, 6, 7); }

/// The sum of the rows of `m`, each times its component of `x`: the transpose of `m` times x. The fourth number of each
/// half is not used.
template <class Numbers>
GEM_INLINE Numbers times_transpose(const BlockRows& m, Numbers x) {
  return (widen(m.row[0], x) * spread(x, 0) + widen(m.row[1], x) * spread(x, 1)) + widen(m.row[2], x) * spread(x, 2);
}

template <class Numbers>
GEM_INLINE Numbers load(const float* from) {
  Numbers x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}

template <class Numbers>
GEM_INLINE void store(const Numbers& x, float* to) {
  __builtin_memcpy(to, &x, sizeof x);
}

}  // namespace

template <class Numbers>
GEM_INLINE void BodyFactor::solve(float* x) const {
  const std::int32_t n = bodies();
  for (std::int32_t column = 0; column < n; ++column) {
    const auto own = load<Numbers>(x + row_numbers * column);
    for (std::int32_t k = first_[column]; k < first_[column + 1]; ++k) {
      float* const to = x + row_numbers * row_[k];
      store(load<Numbers>(to) - times_transpose(transposed(rows_of(&lower_[block * k])), own), to);
    }
  }
  for (std::int32_t column = n - 1; column >= 0; --column) {
    float* const own = x + row_numbers * column;
    Numbers sum = times_transpose(rows_of(&inverse_[block * column]), load<Numbers>(own));  // symmetric
    for (std::int32_t k = first_[column]; k < first_[column + 1]; ++k)
      sum -= times_transpose(rows_of(&lower_[block * k]), load<Numbers>(x + row_numbers * row_[k]));
    store(sum, own);
  }
}

GEM_CLONES void BodyFactor::solve_first(float* x) const { solve<FloatHalf>(x); }
GEM_CLONES void BodyFactor::solve_both(float* x) const { solve<FloatPack>(x); }

}  // namespace gem::bench
