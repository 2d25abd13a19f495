// The state of a field: bodies as arrays. Body 0 is the platform, then the fixed bodies, then the floes.
//
// A platform of several convex pieces has a body for each: 0 to platform_bodies() - 1. All have its place and its
// motion, and their outlines are about its one centroid. Body 0 owns them: it has mass and inertia and takes the
// impulses. The others have no mass of their own, but the inverse mass and inertia, the area and the radius of the
// whole platform.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

enum class BodyKind : std::uint8_t { platform = 0, fixed = 1, floe = 2 };

/// All bodies of one scene. Arrays of length count() unless said otherwise. SI units.
/// Outlines are convex, counter-clockwise, in body coordinates about the centroid.
struct Bodies {
  // Properties: constant during a run.
  std::vector<BodyKind> kind;
  std::vector<std::uint8_t> ice_class;  // index into FloesDef::classes; 0 for bodies that are not ice
  std::vector<std::int32_t>
      vertex_begin;                  // count() + 1 entries: outline of i is vertex[vertex_begin[i]..vertex_begin[i+1])
  std::vector<Vec2> vertex;          // [m]
  std::vector<double> radius;        // farthest vertex from the centroid; of pieces: of all [m]
  std::vector<double> area;          // [m2]
  std::vector<double> thickness;     // [m]; contact height for a body that is not ice
  std::vector<double> mass;          // [kg]; 0 for fixed bodies
  std::vector<double> inertia;       // about the centroid [kg m2]; 0 for fixed bodies
  std::vector<double> inverse_mass;  // [1/kg]; 0 for fixed bodies and a fixed platform
  std::vector<double> inverse_inertia;  // [1/(kg m2)]; 0 for fixed bodies, a fixed platform and locked yaw
  std::vector<double> drag;             // k of dw/dt = -k |w| w [1/m] (quadratic) or 1/tau [1/s] (linear)
  std::vector<double> spin_drag;        // k of dω/dt = -k |ω| ω [-] (quadratic) or 1/tau [1/s] (linear)

  // Motion.
  std::vector<Vec2> position;  // centroid, world [m]
  std::vector<Rotation> rotation;
  std::vector<Vec2> velocity;        // [m/s]
  std::vector<double> spin;          // [rad/s]
  std::vector<std::uint8_t> active;  // 0: retired, no longer takes part

  std::size_t count() const { return kind.size(); }
  int vertex_count(std::size_t i) const { return vertex_begin[i + 1] - vertex_begin[i]; }
};

/// Everything needed to append one body; mass and inertia follow from the outline, density and thickness.
struct BodyDef {
  BodyKind kind = BodyKind::floe;
  std::vector<Vec2> outline;  // counter-clockwise, convex, any origin [m]
  Vec2 origin;                // where the outline's origin stands in the world [m]
  Rotation rotation;
  Vec2 velocity;           // [m/s]
  double spin = 0.0;       // [rad/s]
  double thickness = 0.5;  // [m]
  double density = 900.0;  // [kg/m3]
  double mass = 0.0;       // > 0: replaces density x area x thickness, e.g. for the platform [kg]
  double inertia = 0.0;    // > 0: replaces that of the mass spread over the outline [kg m2]
  std::uint8_t ice_class = 0;
  bool locked_yaw = false;
  bool immovable = false;  // a platform that keeps its mass, but does not move
};

/// Number of bodies that are the platform: its pieces. 1 for a platform of one piece, or none.
std::int32_t platform_bodies(const Bodies& bodies);

/// Appends a body. A platform without outline (absent) is allowed; fixed bodies get zero inverse mass and inertia.
void append(Bodies& bodies, const BodyDef& def);

/// Appends the platform `def` as pieces: outlines in its axes that do not overlap, about their common centroid [m]. The
/// outline of `def` is not used.
void append_pieces(Bodies& bodies, const BodyDef& def, const std::vector<std::vector<Vec2>>& pieces);

/// Outline of body i in world coordinates [m].
std::vector<Vec2> world_outline(const Bodies& bodies, std::size_t i);

}  // namespace gem
