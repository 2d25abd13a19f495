// The separating axis of a piece of one rigid body and another body: a normal of the whole outline.
#pragma once

#include "gem/geometry/piece_joints.h"
#include "gem/geometry/separating_axes.h"

namespace gem {

/// What the axis of a pair of a piece and another body is to the whole outline.
enum class PieceAxis {
  outer,     ///< a normal of the whole
  replaced,  ///< none; now it is the normal of the outer side that parts the bodies most
  none       ///< none, and no outer side faces the other body: another piece has the contact
};

/// Looks at `axis` of the piece `a`, which is turned by `rotation`, and of `b`; `corners` are those of the piece. A
/// replaced axis holds only where both outlines face each other along the side.
PieceAxis find_outer_axis(const Outline& a, const PieceCorner* corners, Rotation rotation, const Outline& b,
                          Vec2 offset, Separation& axis);

}  // namespace gem
