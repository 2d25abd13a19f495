// Finds touching bodies at the start of a time step by testing every pair.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/events/friction_memory.h"
#include "gem/events/impact.h"
#include "gem/field/bodies.h"
#include "gem/geometry/convex_contact.h"
#include "gem/geometry/piece_axis.h"
#include "gem/scene/scene_def.h"

namespace gem::reference {

inline CollisionMass mass_of(const Bodies& b, std::int32_t i) { return {b.inverse_mass[i], b.inverse_inertia[i]}; }

/// The body that takes the impulses of body i: body 0 of all pieces of the platform.
inline std::int32_t owner_of(const Bodies& b, std::int32_t i) { return b.kind[i] == BodyKind::platform ? 0 : i; }

/// One point of a touch. "Tangential" is along the normal turned left. Impulses act on B; A gets the opposite.
struct TouchPoint {
  Vec2 arm_a, arm_b;                                     // from the centroids [m]
  double separation = 0.0;                               // < 0: overlap depth [m]
  int feature = 0;                                       // the touching corner, see contact_geometry.h
  double normal_before = 0.0;                            // velocity of B relative to A before the events [m/s]
  double tangential_before = 0.0;                        // [m/s]
  double target = 0.0;                                   // smallest normal velocity after the events [m/s]
  double cap = std::numeric_limits<double>::infinity();  // largest normal impulse [N s]
  ContactImpulse impulse;                                // [N s]
  double elastic = 0.0;                                  // part of the normal impulse that is elastic stress [N s]
  double repair = 0.0;                                   // impulse of the position repair [kg m]
  ContactImpulse last;                                   // impulse of the last time step [N s]
  double rise = 0.0;                                     // of its normal impulse [N s]
  SpareFriction spare;                                   // that it left to this one [N s]

  bool acted() const { return impulse.normal != 0.0 || impulse.tangential != 0.0 || repair != 0.0; }
};

/// A touching pair, or one with faces closer than the contact margin. A has the lower id; the normal points from A to
/// B.
struct Touch {
  std::int32_t a = 0, b = 0;
  Vec2 normal;
  double width = 0.0;          // chord or length of the facing edges [m]
  double growth = 0.0;         // growth of the chord with depth [-]
  double friction = 0.0;       // coefficient [-]
  double largest_force = 0.0;  // compliant: normal force within the time step [N]
  std::vector<TouchPoint> points;
};

/// An outline in world axes relative to its centroid.
struct TurnedOutline {
  std::vector<Vec2> corner, normal;  // [m], outward unit normals of the edges that follow the corners
  Outline view() const { return {corner.data(), normal.data(), static_cast<int>(corner.size())}; }
};

/// Outline of body `i` at its current position.
TurnedOutline turned_outline(const Bodies& bodies, std::size_t i);

/// All pairs that are closer than `margin` [m], ascending in (a, b). Two fixed bodies never touch, nor do two pieces of
/// the platform. `corners` are the joints of the pieces: corners_of_pieces(), or none for a platform of one piece.
std::vector<Touch> all_touches(const Bodies& bodies, const std::vector<PieceCorner>& corners, Manifold manifold,
                               double margin);

}  // namespace gem::reference
