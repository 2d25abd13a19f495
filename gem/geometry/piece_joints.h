// Where convex pieces of one rigid body touch: which sides and corners of a piece can meet another body.
//
// A piece alone would stop a floe at a joint: at a side that another piece covers, or at a corner where the outline of
// the whole goes straight on. So a contact of a piece keeps its normal only where that is a normal of the whole
// outline. The normals of a convex outline at a corner are those between the normals of its two sides. The normals of
// the whole at a corner that several pieces share are those that all of them have there. There are none where it turns
// inwards.
#pragma once

#include <vector>

#include "gem/base/macros.h"
#include "gem/base/vec2.h"

namespace gem {

/// Pieces nearer than this touch, and may overlap by it [m].
inline constexpr double piece_touch = 1e-3;

/// Directions from `first` counter-clockwise to `last`, less than half a turn apart.
struct Normals {
  Vec2 first, last;

  GEM_HD bool hold(Vec2 n) const {
    // sine of the angle below which two directions are one: far above rounding, far below angles between sides
    constexpr double one_direction = 1e-6;
    return cross(first, n) >= -one_direction && cross(n, last) >= -one_direction && dot(n, first + last) > 0.0;
  }
};

/// One corner of a piece, and the side that starts at it.
struct PieceCorner {
  bool is_joint = false;    // the corner lies on another piece
  bool is_inside = false;   // the side lies along other pieces over its whole length
  bool has_normal = false;  // of a joint: the whole outline has `normals` here
  Normals normals;          // in the axes of the body
};

/// Of all corners, piece by piece. Outlines are convex, counter-clockwise, in the axes of the body [m].
std::vector<PieceCorner> piece_corners(const std::vector<std::vector<Vec2>>& pieces);

}  // namespace gem
