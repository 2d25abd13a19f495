// The points of an island in the memory of a device: each field of SplitPoint, or of GradientPoint, for all points, so
// that neighbouring threads read neighbouring numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "gem/engine/solver/splitting/gradient_point.h"
#include "gem/engine/solver/splitting/island_view.h"

namespace gem {

/// A range of fields.
struct FieldRange {
  std::size_t first, count;
};

namespace point_fields {
using Point = SplitPoint<float>;
constexpr std::size_t all_fields = sizeof(Point) / sizeof(float);
constexpr FieldRange all{0, all_fields};
constexpr FieldRange stiffness{offsetof(Point, stiff_n) / 4, 4};  // and softness
constexpr FieldRange base{offsetof(Point, excess) / 4, 15};       // bounds, impulses, copies
constexpr FieldRange moves{offsetof(Point, normal) / 4, 7};       // impulses, copies
constexpr FieldRange answer{offsetof(Point, answer_n) / 4, 3};
constexpr FieldRange scale{offsetof(Point, scale_n) / 4, 2};
constexpr FieldRange watch{offsetof(Point, last_n) / 4, 4};
static_assert(offsetof(Point, shift_t) / 4 == moves.first + moves.count - 1 &&
              offsetof(Point, shift_t) / 4 == base.first + base.count - 1);
static_assert(offsetof(Point, count_t) / 4 == watch.first + watch.count - 1);
}  // namespace point_fields

namespace gradient_fields {
using Point = GradientPoint<float>;
constexpr FieldRange all{0, sizeof(Point) / sizeof(float)};
constexpr FieldRange moves{offsetof(Point, ahead_n) / 4, 6};  // additions, extrapolated and plain
static_assert(offsetof(Point, answer_r) / 4 == moves.first + moves.count - 1);
}  // namespace gradient_fields

/// First number of the fields of a kind of points.
GEM_DEVICE GEM_INLINE float* fields_of(const IslandView& v, const SplitPoint<float>&) { return v.m.point; }
GEM_DEVICE GEM_INLINE float* fields_of(const IslandView& v, const GradientPoint<float>&) { return v.m.gradient_point; }

template <class Point, std::size_t... f>
GEM_DEVICE GEM_INLINE void load_fields(const IslandView& v, std::int32_t k, Point& q, std::index_sequence<f...>) {
  const auto load = [&](std::size_t field) {
    const float x = fields_of(v, q)[static_cast<std::int64_t>(field) * v.m.points_capacity + k];
    __builtin_memcpy(reinterpret_cast<std::byte*>(&q) + 4 * field, &x, sizeof x);
  };
  (load(f), ...);
}
template <FieldRange range, class Point, std::size_t... f>
GEM_DEVICE GEM_INLINE void store_fields(const IslandView& v, std::int32_t k, const Point& q,
                                        std::index_sequence<f...>) {
  [[maybe_unused]] const auto store = [&](std::size_t field) {
    float x;
    __builtin_memcpy(&x, reinterpret_cast<const std::byte*>(&q) + 4 * field, sizeof x);
    fields_of(v, q)[static_cast<std::int64_t>(field) * v.m.points_capacity + k] = x;
  };
  (store(range.first + f), ...);
}

/// Point `k` of an island. Fields that are not used afterwards are not read.
template <class Point>
GEM_DEVICE GEM_INLINE Point load_point(const IslandView& v, std::int32_t k) {
  Point q;
  load_fields(v, k, q, std::make_index_sequence<sizeof(Point) / sizeof(float)>{});
  return q;
}
template <FieldRange range, class Point>
GEM_DEVICE GEM_INLINE void store_point(const IslandView& v, std::int32_t k, const Point& q) {
  store_fields<range>(v, k, q, std::make_index_sequence<range.count>{});
}

}  // namespace gem
