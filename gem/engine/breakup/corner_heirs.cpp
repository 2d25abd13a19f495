// Renames the corners in the saved state.
#include "gem/engine/breakup/corner_heirs.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "gem/engine/contact/corners.h"
#include "gem/engine/contact_key.h"

namespace gem {
namespace {

using Remembered = std::pair<std::uint64_t, CornerMemory>;

/// An outline in world axes about its centroid.
struct TurnedOutline {
  std::vector<Vec2> corner, normal;

  TurnedOutline(const Bodies& b, std::int32_t i) {
    for (std::int32_t v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v)
      corner.push_back(rotate(b.rotation[i], b.vertex[v]));
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec2 side = corner[k + 1 < corner.size() ? k + 1 : 0] - corner[k];
      normal.push_back((1.0 / length(side)) * turned_right(side));
    }
  }
  Surface surface() const { return {{corner.data(), normal.data(), static_cast<int>(corner.size())}}; }
};

/// A corner of body p that remembers something of body q.
struct Corner {
  std::int32_t p = 0, q = 0, index = 0;
};

std::uint64_t key_of(const Corner& c) { return corner_key(std::min(c.p, c.q), std::max(c.p, c.q), c.index, c.p > c.q); }

Corner corner_of_key(std::uint64_t key) {
  const std::int32_t a = body_a_of(key), b = body_b_of(key);
  return is_of_second(key) ? Corner{b, a, corner_of(key)} : Corner{a, b, corner_of(key)};
}

/// Place of a corner in the world [m]. The corners of the platform are those of its pieces, one after the other.
Vec2 place_of(const Bodies& b, const Corner& c) {
  const std::int32_t v = b.vertex_begin[c.p] + c.index;
  std::int32_t i = c.p;
  while (b.vertex_begin[i + 1] <= v) ++i;
  return b.position[i] + rotate(b.rotation[i], b.vertex[v]);
}

class Heirs {
 public:
  Heirs(EngineState& state, const std::vector<FloeSplit>& splits) : state_(state), b_(state.bodies), splits_(splits) {
    for (std::size_t k = 0; k < state.corner_key.size(); ++k) keep(state.corner_key[k], state.corner_value[k]);
    sort();
  }

  void write() const {
    state_.corner_key.clear();
    state_.corner_value.clear();
    for (const auto& [key, memory] : remembered_) {
      state_.corner_key.push_back(key);
      state_.corner_value.push_back(memory);
    }
  }

 private:
  const FloeSplit* split_of(std::int32_t floe) const {
    for (const FloeSplit& split : splits_)
      if (split.floe == floe) return &split;
    return nullptr;
  }

  void keep(std::uint64_t key, const CornerMemory& memory) {
    Corner corner = corner_of_key(key);
    const FloeSplit *of_p = split_of(corner.p), *of_q = split_of(corner.q);
    const Vec2 place = place_of(b_, corner);
    if (of_p) take_corner(*of_p, place, corner);
    if (of_q) corner.q = piece_around(*of_q, place);
    remembered_.emplace_back(key_of(corner), memory);
    if (of_q) remembered_.back().second.pressed_side = -1;  // sides have other numbers now
  }

  /// The piece that has the corner; an end of the crack is the left piece's.
  void take_corner(const FloeSplit& split, Vec2 place, Corner& corner) const {
    double nearest = 1e300;
    for (const std::int32_t piece : split.piece)
      for (std::int32_t k = 0; k < static_cast<std::int32_t>(b_.vertex_count(piece)); ++k) {
        const double distance = length(place_of(b_, {piece, 0, k}) - place);
        if (!(distance < nearest - same_place)) continue;
        nearest = distance;
        corner.p = piece;
        corner.index = k;
      }
  }

  /// The piece that a place is in, or nearest to.
  std::int32_t piece_around(const FloeSplit& split, Vec2 place) const {
    const auto outside = [&](std::int32_t piece) {
      const TurnedOutline outline(b_, piece);
      return outermost_side(outline.surface(), place - b_.position[piece]).distance;
    };
    return split.piece[outside(split.piece[1]) < outside(split.piece[0]) ? 1 : 0];
  }

  static bool before(const Remembered& p, const Remembered& q) { return p.first < q.first; }
  static bool same(const Remembered& p, const Remembered& q) { return p.first == q.first; }

  void sort() {
    std::stable_sort(remembered_.begin(), remembered_.end(), before);
    remembered_.erase(std::unique(remembered_.begin(), remembered_.end(), same), remembered_.end());
  }

  /// Rounding of places [m]; outlines have no edge so short.
  static constexpr double same_place = 1e-6;

  EngineState& state_;
  const Bodies& b_;
  const std::vector<FloeSplit>& splits_;
  std::vector<Remembered> remembered_;
};

}  // namespace

void hand_on_corners(EngineState& state, const std::vector<FloeSplit>& splits) {
  Heirs heirs(state, splits);
  heirs.write();
}

}  // namespace gem
